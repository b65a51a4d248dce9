// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include <chrono>
#include <string>

namespace cortex::comms {

// A command to an agent's own simplex, from its sending to its answer.
struct Errand {
    using Moment = std::chrono::steady_clock::time_point;
    using Milliseconds = std::chrono::milliseconds;

    std::string agent, prefix{};
    std::uint64_t number = 0;  // the mirror's; 0: it is over
    Moment sent{};
    CommandAnswer answer{};

    bool over() const { return number == 0; }
    // An agent that is gone, has no control, or cannot take the arguments, has answered with that.
    void send(Mirror& mirror, const char* command, const Mirror::Arguments& arguments,
              Milliseconds budget);
    // Whether it is over by now; without an answer within `limit` it is Unknown.
    bool poll(Mirror& mirror, Moment now, Milliseconds limit);
};

}  // namespace cortex::comms
