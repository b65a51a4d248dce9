// SPDX-License-Identifier: Apache-2.0
#include "live/causes.hpp"

#include <algorithm>

namespace cortex::cli {

namespace {

// What makes this one not good, as its agent says; empty: itself, or nothing.
std::string causeOf(const FoundSimplex& simplex, const comms::AgentImage& image) {
    if (!image || &image->structure() != simplex.structure.get()) return {};
    const SlotState& state = image->state(simplex.index);
    const auto& all = simplex.structure->simplexes;
    const bool another = state.quality != Quality::Good && state.cause < all.size();
    return another && state.cause != simplex.index ? all[state.cause].path : std::string{};
}

}  // namespace

std::vector<Cause> causesOf(Live& live, const FoundSimplex& simplex,
                            const comms::AgentImage& image) {
    std::vector<Cause> causes;
    std::string path = causeOf(simplex, image);
    while (!path.empty() && std::ranges::find(causes, path, &Cause::path) == causes.end()) {
        const auto owner = live.waitForOwner(path);
        causes.push_back({path, owner.value_or("")});
        if (!owner || path == simplex.info().path) break;
        try {
            const FoundSimplex next = live.find(path);
            path = causeOf(next, live.values(next));
        } catch (const Failure&) {
            break;  // it is gone by now
        }
    }
    return causes;
}

std::string causesText(const std::vector<Cause>& causes) {
    std::string text;
    for (const Cause& each : causes) {
        text += (text.empty() ? "" : " <- ") + each.path +
                (each.agent.empty() ? ", which is not heard" : " of " + each.agent);
    }
    return text;
}

}  // namespace cortex::cli
