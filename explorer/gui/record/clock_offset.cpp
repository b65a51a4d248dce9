// SPDX-License-Identifier: Apache-2.0
#include "record/clock_offset.hpp"

#include <algorithm>
#include <cstdlib>

namespace cortex::gui {

namespace {

constexpr std::int64_t millisecond = 1'000'000, wholeSecond = 1'000 * millisecond;  // ns
constexpr std::int64_t looksBack = 20 * wholeSecond;
constexpr std::int64_t least = 50 * millisecond;   // that is told
constexpr std::int64_t steady = 20 * millisecond;  // that an estimate may wander

}  // namespace

// The first second is left out: what comes first may be old.
void ClockOffset::add(std::int64_t theirs, std::int64_t ours) {
    const std::int64_t ahead = theirs - ours;
    const bool back = !seconds_.empty() && ours < seconds_.back().start;  // our clock was set
    if (back) seconds_.clear();
    if (begun_ == 0 || back) begun_ = ours;
    if (ours - begun_ < wholeSecond) return;
    if (seconds_.empty() || ours - seconds_.back().start >= wholeSecond) {
        seconds_.push_back({ours, ahead});
        while (seconds_.front().start < ours - looksBack) seconds_.pop_front();
    }
    seconds_.back().most = std::max(seconds_.back().most, ahead);
    settle();
}

std::int64_t ClockOffset::estimate() const {
    return std::ranges::max(seconds_, {}, &Second::most).most;
}

void ClockOffset::settle() {
    const std::int64_t now = estimate();
    if (std::abs(now - shift_) <= steady) return;
    shift_ = std::abs(now) > least ? now : 0;
}

}  // namespace cortex::gui
