// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include <string>

// What tools say of the loop of an agent.
namespace cortex::cli {

std::string rateText(const comms::AgentStatus& agent);  // "100 Hz"; "-" without a period
// "hangs in /ctl.stateActive for 8.5 s", "is overloaded: it runs at 9.1 Hz instead of 100 Hz", or
// "" while it runs as it should.
std::string loopTrouble(const comms::AgentStatus& agent);

}  // namespace cortex::cli
