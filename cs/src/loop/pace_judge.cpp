// SPDX-License-Identifier: Apache-2.0
#include "loop/pace_judge.hpp"

#include "cortex/core/clock.hpp"

#include <algorithm>

namespace cortex::cs {

PaceJudge::PaceJudge(std::int64_t period)
    : period_{period}, window_{std::max(nsPerSecond, 10 * period)} {}

bool PaceJudge::add(std::int64_t nominalTime, std::int64_t now) {
    const bool first = since_ < 0;
    if (!first && nominalTime - since_ < window_) {
        ++cycles_;
        return false;
    }
    if (!first) {
        const std::int64_t due = (nominalTime - since_) / period_;
        // After a cycle that began late, less time has passed than the cycles stand for.
        const std::int64_t passed = std::max(now - sinceNow_, nominalTime - since_);
        rate_ = static_cast<double>(cycles_) * 1e9 / static_cast<double>(passed);
        const bool late = 10 * cycles_ < 9 * due;
        changed_ = late == before_ && late != overloaded_;
        if (changed_) overloaded_ = late;
        before_ = late;
    }
    since_ = nominalTime;
    sinceNow_ = now;
    cycles_ = 1;
    return !first;
}

}  // namespace cortex::cs
