// SPDX-License-Identifier: Apache-2.0
#include "live/loop_text.hpp"

#include "common/loop_text.hpp"

namespace cortex::cli {

std::string rateText(const comms::AgentStatus& agent) {
    const std::string text = common::rateText(agent);
    return text.empty() ? "-" : text;
}

std::string loopTrouble(const comms::AgentStatus& agent) {
    if (!agent.standstill.empty() || !agent.overloaded) return agent.standstill;
    if (agent.rate > 0 && !common::isSlow(agent)) return "was overloaded until just now";
    return "is overloaded: it runs at " + common::hertzText(agent.rate) + " Hz instead of " +
           common::hertzText(common::nominalRate(agent)) + " Hz";
}

}  // namespace cortex::cli
