// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include <string>

// What is said of the loop of an agent.
namespace cortex::common {

double nominalRate(const comms::AgentStatus& agent);    // Hz; 0: it has no period
std::string hertzText(double rate);                     // "9.1", "0.25", "1000"; no exponent
std::string rateText(const comms::AgentStatus& agent);  // "100 Hz", "9.1 of 100 Hz"; "": no period
// Whether it is as slow as an agent calls overloaded. The judgement lags behind the rate.
bool isSlow(const comms::AgentStatus& agent);

}  // namespace cortex::common
