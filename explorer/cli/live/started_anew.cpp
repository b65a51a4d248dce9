// SPDX-License-Identifier: Apache-2.0
#include "live/started_anew.hpp"

#include <algorithm>

namespace cortex::cli {

std::vector<std::string> startedAnew(const Starts& starts,
                                     const std::vector<comms::AgentStatus>& now) {
    std::vector<std::string> anew;
    for (const auto& [agent, epoch] : starts) {
        const bool goesOn = std::ranges::any_of(now, [&](const comms::AgentStatus& each) {
            return each.name == agent && each.epoch == epoch && each.state != "lost";
        });
        if (!goesOn) anew.push_back(agent);
    }
    return anew;
}

}  // namespace cortex::cli
