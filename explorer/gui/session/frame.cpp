// SPDX-License-Identifier: Apache-2.0
#include "session/frame.hpp"

#include "cortex/core/path.hpp"

#include "common/image_items.hpp"
#include "common/live_rule.hpp"
#include "common/shown_age.hpp"

#include <algorithm>

namespace cortex::gui {

AgentFrame AgentFrame::later(double seconds) const {
    AgentFrame result = *this;
    result.status.age += seconds;
    for (float& age : result.ages) {
        if (age >= 0) age += static_cast<float>(seconds);
    }
    return result;
}

bool AgentFrame::beats() const { return !lost() && status.standstill.empty() && status.age < 1; }

std::uint32_t AgentFrame::own() const {
    return structure ? structure->find("/" + status.name) : noSimplex;
}

Quality AgentFrame::quality(std::uint32_t simplex) const {
    return came(simplex) ? (*image)->state(simplex).quality : Quality::Lost;
}

std::optional<Value> AgentFrame::value(std::uint32_t simplex, const ItemLayout& item) const {
    if (came(simplex) && common::neverCame(*image, simplex, *item.item)) return std::nullopt;
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
    return image ? common::stateOf(*image, simplex) : std::nullopt;
}

common::StaleDemand AgentFrame::stale(std::uint32_t simplex) const {
    if (!came(simplex)) return {};
    return common::safeBecause(simplex, (*image)->state(simplex), *image);
}

bool AgentFrame::isSafe(std::uint32_t simplex) const {
    return came(simplex) && common::isSafe(simplex, (*image)->state(simplex), *image);
}

bool AgentFrame::live(std::uint32_t simplex) const {
    return image && common::isLive(status, *image, simplex, isSafe(simplex));
}

bool AgentFrame::live(std::uint32_t simplex, const DataItem& item) const {
    if (item.constant) return true;
    return image && common::isLive(status, *image, simplex, isSafe(simplex), item);
}

// What makes it not good is another one, and neither it nor who writes it does anything with that.
bool AgentFrame::standsBy(std::uint32_t simplex, std::uint32_t cause) const {
    if (cause == simplex) return false;
    if (state(simplex) == State::Standby) return true;
    const auto& writers = structure->simplexes[simplex].writers;
    return !writers.empty() && std::ranges::all_of(writers, [&](std::uint32_t writer) {
        return writer != cause && state(writer) == State::Standby;
    });
}

bool AgentFrame::works(std::uint32_t simplex) const {
    const auto doesWork = [this](std::uint32_t each) {
        const auto now = state(each);
        return now && *now != State::Standby && *now != State::Fault;
    };
    return doesWork(simplex) ||
           std::ranges::any_of(structure->simplexes[simplex].writers, doesWork);
}

bool AgentFrame::rests(std::uint32_t simplex) const {
    if (!beats() || !came(simplex)) return false;
    const SlotState now = (*image)->state(simplex);
    if (now.quality == Quality::Lost) return standsBy(simplex, now.cause);
    if (now.quality != Quality::Stale) return false;
    return state(simplex) == State::Standby || standsBy(simplex, now.cause) ||
           (now.cause < structure->simplexes.size() && state(now.cause) == State::Standby);
}

std::optional<float> AgentFrame::age(std::uint32_t simplex) const {
    if (simplex >= ages.size() || ages[simplex] < 0) return std::nullopt;
    if (came(simplex) && common::neverMeasured(*image, simplex)) return std::nullopt;
    return static_cast<float>(common::shownAge(ages[simplex], status));
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

std::vector<std::string> Control::prefixesOf(const std::string& agent) const {
    std::vector<std::string> prefixes;
    for (const comms::LeaseClient::Lease& each : held) {
        if (each.agent == agent) prefixes.push_back(each.prefix);
    }
    return prefixes;
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

const GoneAgent* Frame::goneFrom(std::string_view path) const {
    const auto here = find(path);
    if (here && !agents[here->agent].status.ended) return nullptr;
    const GoneAgent* found = nullptr;
    for (const GoneAgent& each : gone) {
        const std::uint32_t simplex = each.structure->find(path);
        if (simplex == noSimplex || each.structure->simplexes[simplex].remote) continue;
        if (found == nullptr || each.when > found->when) found = &each;
    }
    return found;
}

std::optional<GoneInput> Frame::goneInput(Place place) const {
    constexpr int mostSteps = 8;  // agents may read each other in a circle
    for (int step = 0; step < mostSteps; ++step) {
        const AgentFrame& agent = agents[place.agent];
        if (agent.lost() || !agent.came(place.simplex)) return {};
        const SlotState state = (*agent.image)->state(place.simplex);
        const auto& all = agent.structure->simplexes;
        const bool another = state.cause < all.size() && state.cause != place.simplex;
        if (state.quality == Quality::Good || !another) return {};
        if (!all[state.cause].remote) {
            place.simplex = state.cause;
            continue;
        }
        const std::string& path = all[state.cause].path;
        if (const GoneAgent* from = goneFrom(path)) return GoneInput{path, from};
        const auto next = find(path);
        if (!next) return {};
        place = *next;
    }
    return {};
}

Excuse Frame::excuse(Place place) const {
    const AgentFrame& agent = agents[place.agent];
    if (agent.status.ended) return Excuse::Ended;
    if (agent.lost() || agent.quality(place.simplex) == Quality::Good) return Excuse::None;
    if (agent.rests(place.simplex)) return Excuse::Rests;
    if (agent.works(place.simplex)) return Excuse::None;  // it would need its input
    const auto input = goneInput(place);
    return input && input->agent->ended ? Excuse::Ended : Excuse::None;
}

}  // namespace cortex::gui
