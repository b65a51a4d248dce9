// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>

namespace cortex::gui {

// How far the clock of an agent is ahead of ours. What comes is late by the way it took, so that
// the quickest of the last 20 s tells it best.
class ClockOffset {
public:
    // When something was taken by their clock, and when it came by ours; UTC ns.
    void add(std::int64_t theirs, std::int64_t ours);
    // ns; 0: it is no more than what a network explains, or not known yet. It stays as it is until
    // it is wrong by more than 20 ms, so that lines do not move with each estimate.
    std::int64_t shift() const { return shift_; }

private:
    struct Second {
        std::int64_t start = 0, most = 0;
    };
    std::int64_t estimate() const;
    void settle();

    std::deque<Second> seconds_;  // the newest last
    std::int64_t begun_ = 0, shift_ = 0;
};

}  // namespace cortex::gui
