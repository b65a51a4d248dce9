// SPDX-License-Identifier: Apache-2.0
#include "common/loop_text.hpp"

#include "common/number_text.hpp"

#include <cmath>

namespace cortex::common {

namespace {

constexpr double nearRates = 0.02;  // of the nominal one: as it should be
constexpr double slowRate = 0.9;
constexpr int rateDigits = 4;

}  // namespace

double nominalRate(const comms::AgentStatus& agent) {
    return agent.period > 0 ? 1e9 / static_cast<double>(agent.period) : 0;
}

std::string hertzText(double rate) { return significantText(rate, rateDigits); }

std::string rateText(const comms::AgentStatus& agent) {
    const double nominal = nominalRate(agent);
    if (nominal == 0) return {};
    const bool differs = agent.rate > 0 && std::abs(agent.rate - nominal) > nearRates * nominal;
    return (differs ? hertzText(agent.rate) + " of " : "") + hertzText(nominal) + " Hz";
}

bool isSlow(const comms::AgentStatus& agent) {
    return agent.rate > 0 && agent.rate < slowRate * nominalRate(agent);
}

}  // namespace cortex::common
