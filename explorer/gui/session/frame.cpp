// SPDX-License-Identifier: Apache-2.0
#include "session/frame.hpp"

#include "cortex/core/path.hpp"

#include <algorithm>

namespace cortex::explorer {

bool AgentFrame::beats() const { return !lost() && status.standstill.empty() && status.age < 1; }

Quality AgentFrame::quality(std::uint32_t simplex) const {
    return came(simplex) ? (*image)->state(simplex).quality : Quality::Lost;
}

std::optional<State> AgentFrame::state(std::uint32_t simplex) const {
    if (!came(simplex)) return std::nullopt;
    const TypeLayout& layout = *structure->simplexes[simplex].layout;
    if (!layout.type->active()) return std::nullopt;
    const ItemLayout* item = layout.find("state");
    if (item == nullptr) return std::nullopt;
    const Value value = (*image)->value(simplex, *item);
    const auto* numbers = std::get_if<std::vector<std::int64_t>>(&value);
    if (numbers == nullptr || numbers->empty()) return std::nullopt;
    const std::int64_t state = numbers->front();
    if (state < 0 || state >= stateCount) return std::nullopt;
    return static_cast<State>(state);
}

std::optional<float> AgentFrame::age(std::uint32_t simplex) const {
    if (simplex >= ages.size() || ages[simplex] < 0) return std::nullopt;
    return ages[simplex];
}

std::vector<std::string> Control::prefixes() const {
    std::vector<std::string> prefixes;
    for (const comms::LeaseClient::Lease& each : held) {
        if (std::ranges::find(prefixes, each.prefix) == prefixes.end()) {
            prefixes.push_back(each.prefix);
        }
    }
    return prefixes;
}

bool Control::covers(const std::string& agent, std::string_view path) const {
    return std::ranges::any_of(held, [&](const comms::LeaseClient::Lease& each) {
        return each.agent == agent && isAtOrBelow(path, each.prefix);
    });
}

std::optional<Place> Frame::find(std::string_view path) const {
    std::optional<Place> found;
    for (std::uint32_t agent = 0; agent < agents.size(); ++agent) {
        const auto& structure = agents[agent].structure;
        if (!structure) continue;
        const std::uint32_t simplex = structure->find(path);
        if (simplex == noSimplex || structure->simplexes[simplex].remote) continue;
        const bool earlier =
            !found || agents[agent].status.epoch < agents[found->agent].status.epoch;
        if (earlier) found = Place{agent, simplex};
    }
    return found;
}

}  // namespace cortex::explorer
