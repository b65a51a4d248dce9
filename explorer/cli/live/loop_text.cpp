// SPDX-License-Identifier: Apache-2.0
#include "live/loop_text.hpp"

#include "cortex/core/value.hpp"

#include <cmath>

namespace cortex::cli {
namespace {

constexpr double nearRates = 0.02;  // of the nominal one

double nominalRate(const comms::AgentStatus& agent) {
    return agent.period > 0 ? 1e9 / static_cast<double>(agent.period) : 0;
}

std::string tenths(double number) { return toText(std::round(number * 10) / 10); }

}  // namespace

std::string rateText(const comms::AgentStatus& agent) {
    const double nominal = nominalRate(agent);
    if (nominal == 0) return "-";
    const bool differs = agent.rate > 0 && std::abs(agent.rate - nominal) > nearRates * nominal;
    return (differs ? tenths(agent.rate) + " of " : "") + tenths(nominal) + " Hz";
}

std::string loopTrouble(const comms::AgentStatus& agent) {
    if (!agent.standstill.empty() || !agent.overloaded) return agent.standstill;
    if (agent.rate > 0 && agent.rate >= 0.9 * nominalRate(agent))
        return "was overloaded until just now";
    return "is overloaded: it runs at " + tenths(agent.rate) + " Hz instead of " +
           tenths(nominalRate(agent)) + " Hz";
}

}  // namespace cortex::cli
