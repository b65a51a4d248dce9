// SPDX-License-Identifier: Apache-2.0
#include "loop/pace_judge.hpp"

#include "cortex/core/clock.hpp"

#include <algorithm>

namespace cortex::cs {

PaceJudge::PaceJudge(std::int64_t period)
    : period_{period}, window_{std::max(nsPerSecond, 10 * period)} {}

bool PaceJudge::add(const Tick& tick, std::int64_t now) {
    const bool first = since_ < 0;
    const std::int64_t counted = tick.nominalTime - since_;
    elapsed_ += tick.elapsed;
    if (!first && counted < window_) {
        ++cycles_;
        return false;
    }
    if (!first) {
        const std::int64_t due = counted / period_;
        // After a cycle that began late, less time has passed than the cycles stand for.
        const std::int64_t passed = std::max(now - sinceNow_, counted);
        motion_ = static_cast<double>(elapsed_) / static_cast<double>(counted);
        rate_ = static_cast<double>(cycles_) * 1e9 / static_cast<double>(passed);
        const bool late = 10 * cycles_ < 9 * due;
        const bool worse = late && motion_ < told_ / 2;
        changed_ = late == before_ && (late != overloaded_ || worse);
        if (changed_) {
            overloaded_ = late;
            told_ = motion_;
        }
        before_ = late;
    }
    since_ = tick.nominalTime;
    sinceNow_ = now;
    cycles_ = 1;
    elapsed_ = 0;
    return !first;
}

}  // namespace cortex::cs
