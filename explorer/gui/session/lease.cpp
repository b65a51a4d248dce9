// SPDX-License-Identifier: Apache-2.0
#include "session/lease.hpp"

#include "cortex/core/path.hpp"

#include <algorithm>
#include <cmath>

namespace cortex::explorer {

namespace {

// An item of the agent's own simplex; empty if its type has it differently.
template <class T>
std::vector<T> itemOf(const AgentFrame& agent, std::uint32_t simplex, const char* name) {
    const ItemLayout* item = agent.structure->simplexes[simplex].layout->find(name);
    if (item == nullptr) return {};
    const Value value = (*agent.image)->value(simplex, *item);
    const auto* found = std::get_if<std::vector<T>>(&value);
    return found != nullptr ? *found : std::vector<T>{};
}

}  // namespace

std::vector<Lease> leasesOf(const AgentFrame& agent) {
    if (!agent.structure) return {};
    const std::uint32_t own = agent.structure->find("/" + agent.status.name);
    if (own == noSimplex || !agent.came(own)) return {};
    const auto prefixes = itemOf<std::string>(agent, own, "leasePrefix");
    const auto holders = itemOf<std::string>(agent, own, "leaseHolder");
    const auto cycles = itemOf<std::int64_t>(agent, own, "leaseSince");
    const auto& image = *agent.image;
    std::vector<Lease> leases;
    for (std::size_t i = 0; i < std::min({prefixes.size(), holders.size(), cycles.size()}); ++i) {
        if (prefixes[i].empty()) continue;
        const double period = static_cast<double>(agent.status.period) * 1e-9;
        const auto held =
            static_cast<double>(std::max<std::int64_t>(image->cycle() - cycles[i], 0));
        Lease lease{prefixes[i], holders[i], 0, held * period};
        lease.since = image->wallClock() - std::llround(lease.seconds * 1e9);
        leases.push_back(std::move(lease));
    }
    std::ranges::sort(leases, {}, &Lease::prefix);
    return leases;
}

std::optional<Lease> leaseOfOthers(const AgentFrame& agent, std::string_view path,
                                   std::string_view self) {
    for (Lease& each : leasesOf(agent)) {
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

}  // namespace cortex::explorer
