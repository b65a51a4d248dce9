// SPDX-License-Identifier: Apache-2.0
// What an agent makes of the samples of a hostile one whose simplexes it links, and of commands.
#include "agent/agent_commands.hpp"
#include "agent/agent_links.hpp"
#include "agent/agent_peers.hpp"
#include "told_script.hpp"

namespace {

using namespace cortex;

// An agent that links two simplexes of the teller.
struct Listener {
    Listener() {
        test::Hand& boss = rig.hand("/listener", "Boss");
        rig.tree.relateRemote(boss, "readings", "/reading");
        rig.tree.relateRemote(boss, "plates", "/plate");
        rig.start();
    }
    test::AgentRig rig{"near"};
};

comms::Command commandOf(std::span<const std::uint8_t> input, const Structure& structure) {
    comms::Command command;
    if (!comms::decode(input, command)) return command;
    command.target = structure.agent;
    command.targetEpoch = structure.epoch;
    command.link = comms::linkId(command.sender, command.target);
    return command;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzz::ToldScript script;
    static Listener listener;
    test::PlayedInterface& outside = listener.rig.outside;
    comms::AgentSelf self{outside.access};
    comms::AgentCommands commands{self, [](const comms::Answer&) {}};
    comms::AgentLinks links{self};
    comms::AgentPeers peers{self, [](const std::string&, std::int64_t) {}};

    const fuzz::ToldScript::Told told = script.play({data, size});
    for (const auto& model : told.models) peers.take(model, 1);
    for (const auto& presence : told.presences) peers.take(presence, 1);
    links.update(peers.all());
    (void)links.interest();
    for (const auto& block : told.blocks) links.take(block, 1);
    commands.take(commandOf({data, size}, self.structure()), 1);
    outside.atRead([&](Inbox& inbox) {
        links.read(inbox);
        commands.read(inbox);
    });
    listener.rig.step();
    outside.answers.clear();
    peers.expire(2'000'000'000);
    links.update(peers.all());
    commands.step(2'000'000'000);
    outside.atRead([&](Inbox& inbox) {
        links.read(inbox);
        commands.read(inbox);
    });
    listener.rig.step();
    outside.answers.clear();
    return 0;
}
