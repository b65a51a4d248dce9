// SPDX-License-Identifier: Apache-2.0
// What a tool makes of the samples of a hostile agent: structure, tables, images.
#include "mirror/mirror_agents.hpp"
#include "told_script.hpp"

namespace {

using namespace cortex;

void readAll(const Image& image) {
    const Structure& structure = image.structure();
    for (const SimplexInfo& info : structure.simplexes) {
        const std::uint32_t simplex = structure.find(info.path);
        if (simplex == noSimplex) std::abort();
        for (const ItemLayout& item : info.layout->items) (void)image.value(simplex, item);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzz::ToldScript script;
    const fuzz::ToldScript::Told told = script.play({data, size});
    const comms::MirrorView everything = comms::viewOf({{{"/"}, 5}, {{"/a", "/c", "/work"}, 0}});
    const comms::Moment now{std::chrono::hours{1}};
    comms::MirrorAgents agents{[](const comms::MirrorAgent&, const char*) {}};
    for (const auto& model : told.models) agents.take(model, now);
    for (const auto& presence : told.presences) agents.take(presence, now);
    agents.tick(everything, now);
    std::size_t stream = 0;
    for (const auto& block : told.blocks) {
        agents.take(block, stream++ % comms::viewRates.size(), now);
    }
    for (const auto& summary : told.summaries) agents.take(summary, now);
    for (auto& [name, agent] : agents.all()) {
        (void)agent.status(now);
        (void)agent.marks(now);
        if (agent.tables) readAll(agent.tables->newest());
    }
    agents.tick(everything, now + std::chrono::seconds{2});
    return 0;
}
