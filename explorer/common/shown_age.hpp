// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include <algorithm>

namespace cortex::common {

// How old what is shown of a simplex is, in s, by the mirror's age of it. Of an agent that is lost
// nothing is younger than its newest cycle.
inline double shownAge(double age, const comms::AgentStatus& agent) {
    return agent.state == "lost" ? std::max(age, agent.age) : age;
}

}  // namespace cortex::common
