// SPDX-License-Identifier: Apache-2.0
#include "session/lease.hpp"

#include "cortex/core/path.hpp"

#include <algorithm>

namespace cortex::gui {

std::vector<comms::ShownLease> leasesOf(const AgentFrame& agent) {
    if (!agent.image) return {};
    return comms::leasesOf(agent.status, *agent.image);
}

std::optional<comms::ShownLease> leaseOfOthers(const AgentFrame& agent, std::string_view path,
                                               std::string_view self) {
    for (comms::ShownLease& each : leasesOf(agent)) {
        if (each.holder == self) continue;
        if (isAtOrBelow(path, each.prefix) || isAtOrBelow(each.prefix, path)) return each;
    }
    return std::nullopt;
}

bool hasBelow(const AgentFrame& agent, std::string_view prefix) {
    return agent.structure &&
           std::ranges::any_of(agent.structure->simplexes, [&](const SimplexInfo& info) {
               return !info.remote && isAtOrBelow(info.path, prefix);
           });
}

}  // namespace cortex::gui
