// SPDX-License-Identifier: Apache-2.0
#include "common/safe_demand.hpp"

#include "common/image_items.hpp"

#include <algorithm>

namespace cortex::common {

namespace {

// What is known of the writer that makes a demand stale.
struct Saying {
    std::uint32_t writer = noSimplex;
    std::optional<State> state{};  // none: it is no such demand, or nothing is known
    bool safe = false;
};

Saying saying(std::uint32_t demand, const SlotState& state, const comms::AgentImage& image) {
    if (!image || image.lost()) return {};
    const auto writer = staleBy(image->structure().simplexes[demand], state);
    const auto writersState = writer ? stateOf(image, *writer) : std::nullopt;
    if (!writersState) return {};
    if (*writersState != State::Active)
        return {*writer, writersState,
                *writersState == State::Standby || *writersState == State::Fault};
    // One that is not good by itself has said so of its values: they are its own.
    const SlotState own = image->state(*writer);
    return {*writer, writersState, own.quality != Quality::Good && own.cause != *writer};
}

}  // namespace

std::optional<std::uint32_t> staleBy(const SimplexInfo& demand, const SlotState& state) {
    const bool stale = demand.role == Role::Modification && state.quality == Quality::Stale;
    if (!stale || std::ranges::find(demand.writers, state.cause) == demand.writers.end()) return {};
    return state.cause;
}

bool isSafe(std::uint32_t demand, const SlotState& state, const comms::AgentImage& image) {
    return saying(demand, state, image).safe;
}

StaleDemand safeBecause(std::uint32_t demand, const SlotState& state,
                        const comms::AgentImage& image) {
    const Saying found = saying(demand, state, image);
    if (!found.state) return {};
    const std::string& path = image->structure().simplexes[found.writer].path;
    if (*found.state == State::Active)
        return found.safe ? StaleDemand{true, path + " has lost an input"} : StaleDemand{};
    return {found.safe, path + " is in " + name(*found.state)};
}

}  // namespace cortex::common
