// SPDX-License-Identifier: Apache-2.0
#include "live/safe_demand.hpp"

#include "live/live_values.hpp"

#include <algorithm>

namespace cortex::cli {

std::optional<std::uint32_t> staleBy(const FoundSimplex& demand, const SlotState& state) {
    const SimplexInfo& info = demand.info();
    const bool stale = info.role == Role::Modification && state.quality == Quality::Stale;
    if (!stale || std::ranges::find(info.writers, state.cause) == info.writers.end()) return {};
    return state.cause;
}

StaleDemand safeBecause(const FoundSimplex& demand, const SlotState& state,
                        const comms::AgentImage& image) {
    const auto writer = staleBy(demand, state);
    const bool known = image && &image->structure() == demand.structure.get();
    if (!writer || !known || !isLive(image, *writer)) return {};
    const auto writersState = stateOf(image, *writer);
    if (!writersState) return {};
    const std::string& path = demand.structure->simplexes[*writer].path;
    const SlotState& own = image->state(*writer);
    // An Active writer that is not good by itself has said so of its values: they are its own.
    const bool lost = own.quality != Quality::Good && own.cause != *writer;
    if (*writersState == State::Active)
        return lost ? StaleDemand{true, path + " has lost an input"} : StaleDemand{};
    const bool rests = *writersState == State::Standby || *writersState == State::Fault;
    return {rests, path + " is in " + name(*writersState)};
}

std::string qualityText(Quality quality, const StaleDemand& demand) {
    return std::string{name(quality)} + (demand.safe ? ", safe" : "");
}

Json safeJson(const StaleDemand& demand) { return demand.safe ? Json(demand.why) : Json(); }

}  // namespace cortex::cli
