// SPDX-License-Identifier: Apache-2.0
#include "live/lease_table.hpp"

#include "live/live_values.hpp"

#include <algorithm>
#include <cmath>

namespace cortex::explorer {
namespace {

// An item of the agent's own simplex; empty if its type has it differently.
template <class T>
std::vector<T> itemOf(const comms::AgentImage& image, std::uint32_t simplex, const char* name) {
    const ItemLayout* item = image->structure().simplexes[simplex].layout->find(name);
    if (item == nullptr) return {};
    const Value value = image->value(simplex, *item);
    const auto* found = std::get_if<std::vector<T>>(&value);
    return found != nullptr ? *found : std::vector<T>{};
}

std::string durationText(double seconds) {
    const auto whole = std::llround(seconds);
    if (whole < 120) return std::to_string(whole) + " s";
    if (whole < 7200) return std::to_string(whole / 60) + " min";
    return std::to_string(whole / 3600) + " h";
}

}  // namespace

std::vector<ShownLease> leasesOf(const comms::Mirror& mirror, const comms::AgentStatus& agent) {
    const comms::AgentImage image = mirror.image(agent.name);
    if (!image) return {};
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
        ShownLease lease{agent.name, prefixes[i], holders[i], 0, held * period};
        lease.since = image->wallClock() - std::llround(lease.seconds * 1e9);
        leases.push_back(std::move(lease));
    }
    std::ranges::sort(leases, {}, &ShownLease::prefix);
    return leases;
}

// A tool has its host in its name, tool@host.process; an agent says its own.
std::string hostOf(const comms::Mirror& mirror, const std::string& holder) {
    for (const comms::AgentStatus& each : mirror.agents()) {
        if (each.name == holder) return each.host;
    }
    const std::size_t at = holder.find('@'), dot = holder.rfind('.');
    if (at == std::string::npos || dot == std::string::npos || dot < at) return "";
    return holder.substr(at + 1, dot - at - 1);
}

std::string holderText(const comms::Mirror& mirror, const ShownLease& lease) {
    const std::string host = hostOf(mirror, lease.holder);
    return lease.holder + (host.empty() ? "" : " on host " + host) + " holds " + lease.prefix +
           " of agent " + lease.agent + " since " + timeText(lease.since) + " (" +
           durationText(lease.seconds) + ")";
}

}  // namespace cortex::explorer
