// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/event.hpp"
#include "cortex/core/realtime.hpp"
#include "cortex/core/tick.hpp"

#include <cstdint>

namespace cortex::cs {

// Episodes of late cycles. One begins with a cycle that began later after its deadline than the
// limit. It ends when none has for a second, or ten periods where that is longer. Loop thread.
class LatenessJudge {
public:
    enum class Change : std::uint8_t { None, Begins, Ends };

    // The limit is `percent` of the period (ns); 0: none. `option`: where it is stated.
    LatenessJudge(std::int64_t period, double percent, const char* option);

    Change add(const Tick& tick) CORTEX_REALTIME;
    bool isAbove(const Tick& tick) const CORTEX_REALTIME {
        return limit_ > 0 && tick.lateness > limit_;
    }
    EventText beginning() const CORTEX_REALTIME;  // of the episode that has begun just now
    EventText ending() const CORTEX_REALTIME;     // of the one that has ended just now

private:
    std::int64_t limit_, silence_;  // ns
    double percent_;
    const char* option_;
    bool inEpisode_ = false;
    std::int64_t firstCycle_ = 0, lastCycle_ = 0, lastTime_ = 0;  // late ones of this episode
    std::int64_t count_ = 0, greatest_ = 0;                       // the same
};

}  // namespace cortex::cs
