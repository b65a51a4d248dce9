// SPDX-License-Identifier: Apache-2.0
#include "leases/errand.hpp"

#include "cortex/core/error.hpp"

#include <utility>

namespace cortex::comms {

void Errand::send(Mirror& mirror, const char* command, const Mirror::Arguments& arguments,
                  Milliseconds budget) {
    sent = std::chrono::steady_clock::now();
    answer = {};
    try {
        number = mirror.send("/" + agent, command, arguments, budget);
    } catch (const Error& error) {
        number = 0;
        answer.outcome = Outcome::Rejected;
        answer.why = error.what();
    }
}

bool Errand::poll(Mirror& mirror, Moment now, Milliseconds limit) {
    if (over()) return true;
    if (mirror.poll(number, answer)) {
        number = 0;
    } else if (now - sent > limit) {
        mirror.abandon(std::exchange(number, 0));
        answer.outcome = Outcome::Unknown;
        answer.why = "no answer within " + std::to_string(limit.count()) + " ms";
    }
    return over();
}

}  // namespace cortex::comms
