// SPDX-License-Identifier: Apache-2.0
#include "told_agent.hpp"

#include "wire/ids.hpp"
#include "wire/simplex_marks.hpp"
#include "wire/simplex_values.hpp"

#include <ranges>

namespace cortex::comms {

ToldAgent::ToldAgent() {
    SimplexTree& tree = rig.tree;
    test::Hand& boss = rig.hand("/boss", "Boss");
    worker = &rig.hand("/work/one");
    const test::Hand& two = rig.hand("/work/two");
    Simplex& reading = tree.add("/reading", "FineReading");
    tree.add("/plate", "Plate");
    reading.set("origin", Value{std::vector{1.5, -2.0, 0.25}});
    boss.runEvery(4, 3);
    tree.relate(boss, "workers", two);
    tree.relate(boss, "workers", *worker);
    tree.relate(boss, "aides", *worker);
    tree.relate(boss, "late", two, true);
    tree.relate(boss, "readings", reading, false, 2.5);
    tree.relateRemote(boss, "plates", "/far/plate", {}, false, 0.1);
    rig.start();
    rig.step();

    const AgentSelf self{rig.outside.access};
    const AgentModel model{self};
    presence = model.presence("running", 1, 0);
    models = model.samples();
}

void ToldAgent::lie(const std::string& path, const std::function<void(SimplexMessage&)>& change) {
    std::vector<SimplexMessage> all;
    for (Model& model : models) {
        for (SimplexMessage& simplex : model.simplexes) {
            if (simplex.path == path) change(simplex);
            all.push_back(simplex);
        }
        model.id = modelId(model);
    }
    presence.structureHash = structureHash(all);
}

void ToldAgent::lie(const std::string& type, const std::function<void(TypeMessage&)>& change) {
    std::map<std::string, TypeHash> hashes;
    for (Model& model : models) {
        for (TypeMessage& message : model.types) {
            if (message.name == type) change(message);
            hashes[message.name] = message.hash;
        }
    }
    presence.typesHash = typesHash(hashes);
}

Block ToldAgent::block(std::uint64_t sequenceNumber) const {
    const Image image = rig.agent->images().newest();
    Block block;
    block.agent = agentId(name());
    block.epoch = epoch();
    block.structureHash = presence.structureHash;
    block.sequenceNumber = sequenceNumber;
    block.cycle = image.cycle();
    block.nominalTime = image.nominalTime();
    block.wallClock = image.wallClock();
    for (std::uint32_t i = 0; i < presence.simplexes; ++i) {
        block.simplexes.emplace_back();
        readValues(i, *structure().simplexes[i].layout, image.slice(i), block.simplexes.back());
    }
    return block;
}

Summary ToldAgent::summary() const {
    const Image image = rig.agent->images().newest();
    Summary summary;
    summary.agent = agentId(name());
    summary.epoch = epoch();
    summary.structureHash = presence.structureHash;
    summary.cycle = image.cycle();
    const SimplexMarks marks{structure()};
    for (std::uint32_t i = 0; i < presence.simplexes; ++i) {
        summary.marks.push_back(octetOf(marks.of(i, image.slice(i))));
    }
    return summary;
}

void tell(const ToldAgent& agent, PeerModel& peer) {
    for (const Model& model : std::views::reverse(agent.models)) peer.add(model);
    peer.add(agent.presence);
}

}  // namespace cortex::comms
