// SPDX-License-Identifier: Apache-2.0
#include "doctor/hearing.hpp"

#include <algorithm>
#include <cstddef>
#include <string>

namespace cortex::cli {
namespace {

constexpr std::int64_t joining = 15'000'000;  // microseconds

}  // namespace

void examineHearing(const std::vector<comms::AgentStatus>& agents, std::int64_t now,
                    Diagnoses& found) {
    const auto isThere = [&](const comms::AgentStatus& each) {
        return each.state != "lost" && now - each.epoch > joining;
    };
    const auto there = static_cast<std::size_t>(std::ranges::count_if(agents, isThere));
    for (const comms::AgentStatus& each : agents) {
        if (!isThere(each) || each.hears == 0 || each.hears >= there) continue;
        found.push_back({Diagnosis::Level::Warning, "agent",
                         each.name + " on " + each.host + " hears " +
                             std::to_string(each.hears - 1) + " of the " +
                             std::to_string(there - 1) + " other agents that are heard here",
                         "look again in some seconds; if it stays so, compare their interfaces, "
                         "peers and security, and start it anew"});
    }
}

}  // namespace cortex::cli
