// SPDX-License-Identifier: Apache-2.0
#include "loop/lateness_judge.hpp"

#include "cortex/core/clock.hpp"

#include <algorithm>
#include <cmath>

namespace cortex::cs {

namespace {

double milliseconds(std::int64_t nanoseconds) {
    return std::round(static_cast<double>(nanoseconds) / 1e3) / 1e3;  // the nearest to three digits
}

}  // namespace

LatenessJudge::LatenessJudge(std::int64_t period, double percent, const char* option)
    : limit_{std::llround(percent / 100 * static_cast<double>(period))},
      silence_{std::max(nsPerSecond, 10 * period)},
      percent_{percent},
      option_{option} {}

LatenessJudge::Change LatenessJudge::add(const Tick& tick) {
    if (!isAbove(tick)) {
        if (!inEpisode_ || tick.nominalTime - lastTime_ < silence_) return Change::None;
        inEpisode_ = false;
        return Change::Ends;
    }
    const bool begins = !inEpisode_;
    if (begins) {
        inEpisode_ = true;
        firstCycle_ = tick.cycle;
        count_ = greatest_ = 0;
    }
    lastCycle_ = tick.cycle;
    lastTime_ = tick.nominalTime;
    ++count_;
    greatest_ = std::max(greatest_, tick.lateness);
    return begins ? Change::Begins : Change::None;
}

EventText LatenessJudge::beginning() const {
    EventText text{"began "};
    return text << milliseconds(greatest_) << " ms after its deadline, more than the " << option_
                << " of " << percent_ << " % allows (" << milliseconds(limit_) << " ms)";
}

EventText LatenessJudge::ending() const {
    EventText text{"no longer late: "};
    return text << count_ << " of " << lastCycle_ - firstCycle_ + 1 << " cycles began more than "
                << milliseconds(limit_) << " ms after their deadlines, the latest "
                << milliseconds(greatest_) << " ms";
}

}  // namespace cortex::cs
