// SPDX-License-Identifier: Apache-2.0
// Participants that lie: what they say is counted and does nothing else.
#include "comms/network_agent.hpp"
#include "comms/raw_dds.hpp"
#include "wire/presence_extras.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

// "near" has linked /far of "away" when the liar begins.
struct HostilePeer : testing::Test {
    HostilePeer() {
        near.rig.tree.relateRemote(near.rig.hand("/boss", "Boss"), "readings", "/far");
        away.rig.tree.add("/far", "Reading").set("a", 7.0);
        near.rig.start();
        away.rig.start();
        liar.connect(2);
    }
    bool linked() {
        return comesTrue([&] {
            away.rig.step();
            near.rig.step();
            return near.rig.agent->images().newest().quality("/far") == Quality::Good;
        });
    }
    std::optional<Presence> presenceOf(const std::string& name) const {
        for (const Presence& each : liar.heard.elements()) {
            if (each.name == name) return each;
        }
        return {};
    }
    // Whether near counts it, with these words.
    testing::AssertionResult rejects(const std::string& words, const std::function<void()>& say) {
        const std::uint64_t before = near.dds.rejected();
        const auto counted = [&] {
            say();
            near.rig.step();
            return near.dds.rejected() > before &&
                   near.dds.lastRejection().find(words) != std::string::npos;
        };
        if (comesTrue(counted)) return testing::AssertionSuccess();
        return testing::AssertionFailure() << "last counted: " << near.dds.lastRejection();
    }

    NetworkAgent near{"near"}, away{"away"};
    RawTool liar{"liar"};
};

TEST_F(HostilePeer, BlocksThatLieDoNothingButCount) {
    ASSERT_TRUE(linked());
    ASSERT_TRUE(comesTrue([&] { return presenceOf("away").has_value(); }));
    const auto writer = liar.participant.writer<Block>(topics::linkOf("away"));
    Block good;
    good.agent = agentId("away");
    good.epoch = away.structure().epoch;
    good.structureHash = presenceOf("away")->structureHash;
    good.sequenceNumber = std::numeric_limits<std::uint64_t>::max() / 2;
    SimplexData data;
    data.index = away.structure().find("/far");
    data.ints = {0};
    data.floats = {666, 666};
    data.bools = {false};
    data.strings = {""};

    const auto say = [&](const std::function<void(Block&, SimplexData&)>& change) {
        return [&, change] {
            Block block = good;
            SimplexData values = data;
            change(block, values);
            ++good.sequenceNumber;
            block.simplexes.push_back(values);
            writer->write(block);
        };
    };
    const std::string of = "values of away for /far: ";
    EXPECT_TRUE(rejects(of + "0 floats instead of 2",
                        say([](Block&, SimplexData& values) { values.floats.clear(); })));
    EXPECT_TRUE(rejects(of + "2 ints instead of 1",
                        say([](Block&, SimplexData& values) { values.ints.push_back(1); })));
    EXPECT_TRUE(rejects(of + "a quality that cannot be",
                        say([](Block&, SimplexData& values) { values.quality = 4; })));
    EXPECT_TRUE(rejects(of + "a stamp that cannot be", say([](Block&, SimplexData& values) {
                            values.time = -(std::int64_t{1} << 60U);
                        })));
    EXPECT_TRUE(
        rejects(of + "a string of 17 octets instead of 16 at most",
                say([](Block&, SimplexData& values) { values.strings = {std::string(17, 'x')}; })));
    EXPECT_TRUE(rejects("of no simplex",
                        say([](Block&, SimplexData& values) { values.index = 0xffffffffU; })));
    EXPECT_TRUE(rejects("another structure",
                        say([](Block& block, SimplexData&) { block.structureHash = {}; })));
    EXPECT_TRUE(rejects("a time", say([](Block& block, SimplexData&) {
                            block.nominalTime = std::numeric_limits<std::int64_t>::max();
                        })));
    EXPECT_TRUE(rejects("a time", say([](Block& block, SimplexData&) { block.nominalTime = -1; })));
    EXPECT_TRUE(rejects("more simplexes", say([](Block& block, SimplexData& values) {
                            block.simplexes.assign(1000, values);
                        })));

    EXPECT_EQ(near.rig.get<double>("/far", "a"), 7.0);
    const auto events = near.rig.events();
    const auto told = [&](const std::string& words) {
        return std::ranges::count(events, "/far: values of away are refused: " + words);
    };
    EXPECT_EQ(told("0 floats instead of 2"), 1) << "once for each reason, on the simplex";
    EXPECT_EQ(told("a stamp that cannot be"), 1);
}

// As a corrupt or spoofed one has it: all that follow look overtaken.
TEST_F(HostilePeer, ABlockWithAHugeNumberHoldsUpTheFollowingOnlyForAMoment) {
    ASSERT_TRUE(linked());
    ASSERT_TRUE(comesTrue([&] { return presenceOf("away").has_value(); }));
    const auto writer = liar.participant.writer<Block>(topics::linkOf("away"));
    SimplexData data;
    data.index = away.structure().find("/far");
    data.ints = {0};
    data.floats = {666, 666};
    data.bools = {false};
    data.strings = {""};
    Block block;
    block.agent = agentId("away");
    block.epoch = away.structure().epoch;
    block.structureHash = presenceOf("away")->structureHash;
    block.sequenceNumber = std::numeric_limits<std::uint64_t>::max();
    block.simplexes = {data};
    ASSERT_TRUE(comesTrue([&] {
        writer->write(block);
        near.rig.step();
        return near.rig.get<double>("/far", "a") == 666;
    }));

    EXPECT_TRUE(comesTrue([&] {
        away.rig.step();
        near.rig.step();
        return near.rig.get<double>("/far", "a") == 7;
    }));
}

// The presences of "away" say that its loop goes on, and no values come.
TEST_F(HostilePeer, ALinkThatStarvesWhileItsAgentRunsIsMadeAnewOnce) {
    ASSERT_TRUE(linked());
    ASSERT_TRUE(comesTrue([&] { return presenceOf("away").has_value(); }));
    const std::string told = "although it runs; the link is made anew";
    Presence said = *presenceOf("away");
    EXPECT_TRUE(comesTrue([&] {
        said.cycle += 1'000;
        liar.presences->write(said);
        near.rig.step();
        return near.rig.hasEvent(told);
    }));
    const std::size_t before = liar.heard.elements().size();
    EXPECT_TRUE(comesTrue([&] {
        said.cycle += 1'000;
        liar.presences->write(said);
        near.rig.step();
        return liar.heard.elements().size() > before + 30;
    }));
    const auto events = near.rig.events();
    EXPECT_EQ(std::ranges::count_if(
                  events, [&](const auto& each) { return each.find(told) != std::string::npos; }),
              1);

    away.rig.tree.at("/far").data<double>("a") = 8;
    EXPECT_TRUE(comesTrue([&] {
        away.rig.step();
        near.rig.step();
        return near.rig.get<double>("/far", "a") == 8;
    }));
}

TEST_F(HostilePeer, BlocksOfOtherStartsAndStrangersAreNotLookedAt) {
    ASSERT_TRUE(linked());
    const auto writer = liar.participant.writer<Block>(topics::linkOf("away"));
    ASSERT_TRUE(comesTrue([&] { return writer->readers() > 0; }));
    Block block;
    block.sequenceNumber = 1;
    block.agent = agentId("away");
    block.epoch = away.structure().epoch + 1;
    ASSERT_TRUE(writer->write(block));
    block.agent = agentId("stranger");
    ASSERT_TRUE(writer->write(block));

    EXPECT_TRUE(linked());
    EXPECT_EQ(near.dds.rejected(), 0U) << near.dds.lastRejection();
}

TEST_F(HostilePeer, PresencesThatCannotBeAreCounted) {
    const auto say = [&](const std::function<void(Presence&)>& change) {
        return [&, change] {
            Presence presence = liar.presence();
            change(presence);
            liar.presences->write(presence);
        };
    };
    EXPECT_TRUE(rejects("id", say([](Presence& each) { each.agent.front() ^= 1; })));
    EXPECT_TRUE(rejects("name or epoch", say([](Presence& each) { each.epoch = -5; })));
    EXPECT_TRUE(rejects("name or epoch", say([](Presence& each) { each.name.clear(); })));
    EXPECT_TRUE(rejects("name or epoch", say([](Presence& each) { each.name.assign(500, 'x'); })));
    EXPECT_TRUE(rejects("future", say([](Presence& each) {
                            each.epoch = std::numeric_limits<std::int64_t>::max();
                        })));
    EXPECT_TRUE(
        rejects("presence of liar", say([](Presence& each) { each.simplexes = 0xffffffffU; })));
    EXPECT_TRUE(near.sees("/near: liar is not heard: its clock is more than a day ahead"));
    EXPECT_TRUE(linked());
}

TEST_F(HostilePeer, ToolsThatAskForThePastAndDieOrNeverCeaseToAskKeepNoOtherFromIt) {
    std::uint64_t number = 0;
    const auto ask = [&](const std::string& name) {
        Presence presence = liar.presence();
        presence.name = name;
        presence.agent = agentId(name);
        presence.extras.push_back({ofThePast, std::to_string(++number) + " 0 1 0 near"});
        liar.presences->write(presence);
    };
    std::size_t answered = 0;
    Inbox<PastMessage> parts;
    const auto reader = liar.participant.reader<PastMessage>(topics::past, parts.push());
    for (int i = 0; i < 300; ++i) ask("dead " + std::to_string(i));
    EXPECT_TRUE(comesTrue([&] {
        for (int i = 0; i < 40; ++i) ask("a greedy one " + std::to_string(i));
        Presence last = liar.presence();
        last.name = "z";
        last.agent = agentId(last.name);
        last.extras.push_back({ofThePast, "7 0 1 0 near"});
        liar.presences->write(last);
        const auto all = parts.elements();
        answered = all.size();
        return std::ranges::any_of(all, [](const PastMessage& each) { return each.tool == "z"; });
    })) << answered;
}

TEST_F(HostilePeer, InterestsThatCannotBeAreCounted) {
    const auto say = [&](const std::function<void(Interest&)>& change) {
        return [&, change] {
            Interest wanted;
            wanted = liar.interest(wanted);
            change(wanted);
            liar.presences->write(liar.presence());
            liar.interests->write(wanted);
        };
    };
    EXPECT_TRUE(rejects("interest of liar", say([](Interest& each) { each.agent.front() ^= 1; })));
    EXPECT_TRUE(rejects("17 Hz", say([](Interest& each) { each.views = {{17, {"/"}}}; })));
    EXPECT_TRUE(rejects("no path", say([](Interest& each) { each.views = {{30, {"far"}}}; })));
    EXPECT_TRUE(linked());
}

TEST_F(HostilePeer, ModelsThatCannotBeAreCounted) {
    const auto say = [&](const std::function<void(Model&)>& change) {
        return [&, change] {
            Model model;
            model.agent = "liar";
            model.epoch = liar.epoch;
            change(model);
            model.id = modelId(model);
            liar.presences->write(liar.presence());
            liar.models->write(model);
        };
    };
    EXPECT_TRUE(rejects("model of liar", say([](Model&) {})));
    EXPECT_TRUE(rejects("model of liar", say([](Model& each) {
                            each.simplexes.resize(1);
                            each.simplexes.front().path = "//";
                        })));
    EXPECT_TRUE(rejects("model of liar", say([](Model& each) {
                            each.simplexes.resize(1);
                            each.types.resize(1);
                        })));
    EXPECT_TRUE(linked());
}

// An agent that has what its presence counts, but no type of it.
TEST_F(HostilePeer, ModelThatContradictsItselfLinksNothing) {
    SimplexMessage simplex;
    simplex.path = "/far";
    simplex.type = "Reading";
    Model model;
    model.agent = "liar";
    model.epoch = 1;
    model.simplexes = {simplex};
    model.id = modelId(model);
    Presence presence = liar.presence();
    presence.epoch = 1;
    presence.role = "agent";
    presence.simplexes = 1;
    presence.structureHash = structureHash(model.simplexes);
    presence.typesHash = typesHash({});

    EXPECT_TRUE(rejects("contradicts itself", [&] {
        liar.models->write(model);
        liar.presences->write(presence);
    }));
    EXPECT_TRUE(near.sees("/near: nothing of liar is linked"));
    EXPECT_TRUE(linked());
    EXPECT_EQ(near.rig.get<double>("/far", "a"), 7.0);
}

TEST_F(HostilePeer, OctetsThatAreNoMessageAreCounted) {
    for (const auto& [topic, type] : {std::pair{topics::presence, Presence::typeName},
                                      std::pair{topics::command, Command::typeName}}) {
        RawWriter writer{loopback(), topic, type};
        ASSERT_TRUE(comesTrue([&] { return writer.readers() > 0; }));
        const std::uint64_t before = near.dds.rejected();
        EXPECT_TRUE(comesTrue([&] {
            writer.write(Id{}, {0, 1, 0, 0, 0xff, 0xff, 0xff});
            return near.dds.rejected() > before;
        })) << topic.name;
    }
    EXPECT_TRUE(linked());
}

}  // namespace
}  // namespace cortex::comms
