// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/archive.hpp"
#include "cortex/core/command.hpp"

#include <cstdint>

namespace cortex::toolkit {

// A jog that lasts for as long as its command is repeated. Once the controller has ended it, what
// is repeated is refused, until a command says velocity 0 or none has come for the time that one
// lasts. So nothing that was ended begins again by itself. A controller that is not Active hears no
// command, so that time begins when it is. Times are nominal, in ns; a value of the tick.
class HeldJog {
public:
    bool lasts(std::int64_t now) const { return now < until_; }
    // A command that lasts for holdTime, in s. False, and the call is rejected: it repeats a jog
    // that was ended.
    bool begin(Call& call, double holdTime, bool moves) CORTEX_REALTIME {
        const auto now = static_cast<std::int64_t>(call.seconds() * 1e9);
        const bool repeats = now < last_ + hold_;
        last_ = now;
        hold_ = moves ? static_cast<std::int64_t>(holdTime * 1e9) : 0;
        ended_ = ended_ && repeats && moves;
        until_ = ended_ ? now : now + hold_;
        if (!ended_) return true;
        call.reject(Reason::State, "the controller has ended this jog: let go before the next one");
        return false;
    }
    // `heard`: the last cycle in which a command could have come.
    void end(std::int64_t heard, std::int64_t now) CORTEX_REALTIME {
        ended_ = heard < last_ + hold_;
        if (ended_) last_ = now;
        until_ = now;
    }
    void keep(Archive& archive) CORTEX_REALTIME {
        archive.time(last_).time(until_) & hold_ & ended_;
    }

private:
    std::int64_t last_ = 0, hold_ = 0;  // of the last command
    std::int64_t until_ = 0;
    bool ended_ = false;
};

}  // namespace cortex::toolkit
