// SPDX-License-Identifier: Apache-2.0
#include "session/frame.hpp"

#include "cortex/core/path.hpp"

#include <algorithm>

namespace cortex::gui {

bool AgentFrame::beats() const { return !lost() && status.standstill.empty() && status.age < 1; }

std::uint32_t AgentFrame::own() const {
    return structure ? structure->find("/" + status.name) : noSimplex;
}

Quality AgentFrame::quality(std::uint32_t simplex) const {
    return came(simplex) ? (*image)->state(simplex).quality : Quality::Lost;
}

std::optional<Value> AgentFrame::value(std::uint32_t simplex, const ItemLayout& item) const {
    if (came(simplex)) return (*image)->value(simplex, item);
    if (!item.item->constant || !structure) return std::nullopt;
    const auto set = std::ranges::find_if(structure->initial, [&](const InitialValue& each) {
        return each.simplex == simplex && each.item->item->name == item.item->name;
    });
    return set != structure->initial.end() ? set->value : item.item->initial;
}

std::optional<State> AgentFrame::state(std::uint32_t simplex) const {
    return lost() ? std::nullopt : lastState(simplex);
}

std::optional<State> AgentFrame::lastState(std::uint32_t simplex) const {
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

bool AgentFrame::rests(std::uint32_t simplex) const {
    if (!beats() || quality(simplex) != Quality::Stale) return false;
    const std::uint32_t cause = (*image)->state(simplex).cause;
    return state(simplex) == State::Standby ||
           (cause < structure->simplexes.size() && state(cause) == State::Standby);
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

std::string Control::common() const {
    std::string path;
    for (const std::string& each : prefixes()) {
        if (path.empty()) path = each;
        while (path != "/" && !isAtOrBelow(each, path)) {
            path.resize(std::max<std::size_t>(path.rfind('/'), 1));
        }
    }
    return path;
}

bool Control::covers(const std::string& agent, std::string_view path) const {
    return std::ranges::any_of(held, [&](const comms::LeaseClient::Lease& each) {
        return each.agent == agent && isAtOrBelow(path, each.prefix);
    });
}

const comms::Contested* Frame::contestOf(std::string_view path) const {
    const auto found = std::ranges::lower_bound(contested, path, {}, &comms::Contested::path);
    return found != contested.end() && found->path == path ? &*found : nullptr;
}

bool Frame::isOwner(std::uint32_t one, std::uint32_t other, std::string_view path) const {
    if (agents[one].lost() != agents[other].lost()) return agents[other].lost();
    const comms::Contested* contest = contestOf(path);
    return contest != nullptr && contest->owner == agents[one].status.name;
}

std::optional<Place> Frame::find(std::string_view path) const {
    std::optional<Place> found;
    for (std::uint32_t agent = 0; agent < agents.size(); ++agent) {
        const auto& structure = agents[agent].structure;
        if (!structure) continue;
        const std::uint32_t simplex = structure->find(path);
        if (simplex == noSimplex || structure->simplexes[simplex].remote) continue;
        if (!found || isOwner(agent, found->agent, path)) found = Place{agent, simplex};
    }
    return found;
}

}  // namespace cortex::gui
