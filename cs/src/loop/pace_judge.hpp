// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/realtime.hpp"
#include "cortex/core/tick.hpp"

#include <cstdint>

namespace cortex::cs {

// Counts the cycles of each second (of ten periods where that is longer). A loop that ran fewer
// than nine tenths of those that were due, twice in a row, is overloaded, until it runs more twice
// in a row: one long cycle is no overload. While it is, half the motion is a change. Loop thread.
class PaceJudge {
public:
    explicit PaceJudge(std::int64_t period);  // ns

    // At the beginning of a cycle, with the time of the clock, ns. Whether a count ended.
    bool add(const Tick& tick, std::int64_t now) CORTEX_REALTIME;
    double rate() const { return rate_; }      // Hz, of the last count
    double motion() const { return motion_; }  // share of the time of this count that motion had
    bool overloaded() const { return overloaded_; }
    bool changed() const { return changed_; }  // by the last count

private:
    std::int64_t period_, window_;
    std::int64_t since_ = -1, sinceNow_ = 0;  // the beginning of this count
    std::int64_t cycles_ = 0, elapsed_ = 0;
    double rate_ = 0, motion_ = 1, told_ = 1;  // told_: the motion at the last change
    bool before_ = false, overloaded_ = false, changed_ = false;
};

}  // namespace cortex::cs
