// SPDX-License-Identifier: Apache-2.0
#include "leases/lease_table.hpp"

#include "cortex/core/control_commands.hpp"

#include <algorithm>
#include <cmath>

namespace cortex::comms {
namespace {

// An item of the agent's own simplex; empty if its type has it differently.
template <class T>
std::vector<T> itemOf(const AgentImage& image, std::uint32_t simplex, const char* name) {
    const ItemLayout* item = image->structure().simplexes[simplex].layout->find(name);
    if (item == nullptr) return {};
    const Value value = image->value(simplex, *item);
    const auto* found = std::get_if<std::vector<T>>(&value);
    return found != nullptr ? *found : std::vector<T>{};
}

}  // namespace

bool isControlCommand(std::string_view command) { return cortex::isControlCommand(command); }

bool isFreeCommand(std::string_view command) {
    return isControlCommand(command) || isUrgentCommand(command);
}

std::vector<ShownLease> leasesOf(const AgentStatus& agent, const AgentImage& image) {
    return shownLeases(agent, image).value_or(std::vector<ShownLease>{});
}

std::optional<std::vector<ShownLease>> shownLeases(const AgentStatus& agent,
                                                   const AgentImage& image) {
    if (!image || agent.state == "lost") return {};  // its last ones say nothing about now
    const std::uint32_t own = image->structure().find("/" + agent.name);
    if (own == noSimplex || !image.came(own)) return {};
    const auto prefixes = itemOf<std::string>(image, own, "leasePrefix");
    const auto holders = itemOf<std::string>(image, own, "leaseHolder");
    const auto cycles = itemOf<std::int64_t>(image, own, "leaseSince");
    std::vector<ShownLease> leases;
    for (std::size_t i = 0; i < std::min({prefixes.size(), holders.size(), cycles.size()}); ++i) {
        if (prefixes[i].empty()) continue;
        const double period = static_cast<double>(agent.period) * 1e-9;
        const auto held =
            static_cast<double>(std::max<std::int64_t>(image->cycle() - cycles[i], 0));
        ShownLease lease{agent.name, prefixes[i], holders[i], 0, held * period, cycles[i]};
        lease.since = image->wallClock() - std::llround(lease.seconds * 1e9);
        leases.push_back(std::move(lease));
    }
    std::ranges::sort(leases, {}, &ShownLease::prefix);
    return leases;
}

}  // namespace cortex::comms
