// SPDX-License-Identifier: Apache-2.0
// What an agent tells of itself and what it asks for, over real DDS on the loopback interface.
#include "cortex/core/clock.hpp"
#include "cortex/core/event_memory.hpp"

#include "comms/network_agent.hpp"
#include "peers/peer_model.hpp"
#include "toolkit/allocation_counter.hpp"
#include "wire/presence_extras.hpp"

#include <algorithm>
#include <functional>
#include <optional>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

struct DdsAgent : testing::Test {
    DdsAgent() { agent.rig.tree.add("/plate", "Plate"); }
    void start() {
        agent.rig.start();
        tool.connect();
        ASSERT_TRUE(hears("running"));
    }
    // The newest presence of the agent.
    std::optional<Presence> heard() const {
        std::optional<Presence> newest;
        for (const Presence& each : tool.heard.elements()) {
            if (each.name == "robot") newest = each;
        }
        return newest;
    }
    bool hears(const std::string& state) {
        return comesTrue([&] {
            const auto presence = heard();
            return presence && presence->state == state;
        });
    }

    RawTool tool{"operator"};
    NetworkAgent agent{"robot"};
};

TEST_F(DdsAgent, TellsItsPresenceTenTimesASecond) {
    start();
    agent.rig.step(5);
    ASSERT_TRUE(comesTrue([&] {
        const auto presence = heard();
        return presence && presence->cycle == 5;
    }));
    const Presence presence = *heard();

    EXPECT_EQ(presence.agent, agentId("robot"));
    EXPECT_EQ(presence.role, "agent");
    EXPECT_EQ(presence.epoch, agent.structure().epoch);
    EXPECT_EQ(presence.period, 1'000'000);
    EXPECT_EQ(presence.simplexes, 2U);
    EXPECT_EQ(presence.majors, std::vector<std::uint16_t>{1});
    EXPECT_TRUE(tool.heard.waitFor(tool.heard.elements().size() + 5));
}

TEST(DdsAgentInRealTime, TellsItsClockItsAgeAndWhyItsLoopStandsStill) {
    NetworkAgent agent{test::commandTypes(), "robot", {.realTime = true}};
    agent.rig.tree.add("/plate", "Plate");
    RawTool tool{"operator"};
    agent.rig.start();
    tool.connect();
    Presence newest;
    const auto hears = [&](const std::function<bool()>& condition) {
        return comesTrue([&] {
            for (const Presence& each : tool.heard.elements()) {
                if (each.name == "robot") newest = each;
            }
            return condition();
        });
    };
    const std::int64_t before = monotonicNow();
    ASSERT_TRUE(hears([&] {
        return numberIn(newest, clockOfAgent) > static_cast<std::uint64_t>(before) &&
               numberIn(newest, ageOfLoop) > 0;
    }));
    EXPECT_EQ(textIn(newest, standstill), "");

    agent.rig.agent->standstill().set({"hangs in /ctl.stateActive", before});
    ASSERT_TRUE(hears([&] { return !textIn(newest, standstill).empty(); }));
    EXPECT_EQ(textIn(newest, standstill), "hangs in /ctl.stateActive");
    EXPECT_GT(numberIn(newest, timeStood), 0U);
    agent.rig.agent->standstill().clear();
    EXPECT_TRUE(hears([&] { return textIn(newest, standstill).empty(); }));
}

TEST(DdsAgentInRealTime, TellsHowFastItsLoopReallyIsAndThatItIsOverloaded) {
    NetworkAgent agent{test::commandTypes(), "robot", {.realTime = true}};
    agent.rig.tree.add("/plate", "Plate");
    RawTool tool{"operator"};
    agent.rig.start();
    tool.connect();
    const auto says = [&](const char* name, const std::string& value) {
        return comesTrue([&] {
            const auto presences = tool.heard.elements();
            return !presences.empty() && textIn(presences.back(), name) == value;
        });
    };

    ASSERT_TRUE(says(rateOfLoop, "")) << "before it is known";
    agent.rig.agent->pace().set(9.1, true);
    EXPECT_TRUE(says(rateOfLoop, "9100"));
    EXPECT_TRUE(says(overloaded, "1"));
    agent.rig.agent->pace().set(100, false);
    EXPECT_TRUE(says(overloaded, ""));
}

TEST_F(DdsAgent, TellsAModelThatMakesTheSameStructure) {
    Inbox<Model> models;
    const auto reader = tool.participant.reader<Model>(topics::model, models.push());
    start();
    PeerModel known{"robot", agent.structure().epoch};
    ASSERT_TRUE(known.add(*heard()));
    std::size_t taken = 0;
    EXPECT_TRUE(comesTrue([&] {
        const auto all = models.elements();
        for (; taken < all.size(); ++taken) known.add(all[taken]);
        return known.complete();
    }));

    const auto structure = known.structure();
    ASSERT_TRUE(structure) << known.findings().text();
    EXPECT_EQ(structure->find("/plate"), agent.structure().find("/plate"));
    EXPECT_EQ(structure->cyclic.floats, agent.structure().cyclic.floats);
}

TEST_F(DdsAgent, TellsItsEventsNumberedAndThatItStops) {
    Inbox<EventMessage> events;
    const auto reader = tool.participant.reader<EventMessage>(topics::event, events.push());
    start();
    const std::uint32_t plate = agent.structure().find("/plate");
    agent.rig.agent->post(agent.rig.agent->thread(0), Severity::Warning, EventKind::Message, plate,
                          "first");
    agent.rig.step();
    ASSERT_TRUE(events.waitFor(1));
    agent.rig.agent->post(agent.rig.agent->thread(0), Severity::Info, EventKind::Message, plate,
                          "last");
    agent.rig.step();
    agent.rig.agent->stop();

    ASSERT_TRUE(events.waitFor(2));
    const auto told = events.elements();
    EXPECT_EQ(told[0].text, "first");
    EXPECT_EQ(told[0].path, "/plate");
    EXPECT_EQ(told[0].severity, "warning");
    EXPECT_EQ(told[1].text, "last");
    EXPECT_EQ(told[1].number, told[0].number + 1);
    ASSERT_TRUE(hears("stopping"));
    EXPECT_EQ(numberIn(*heard(), eventsWritten), told[1].number);
}

TEST_F(DdsAgent, KeepsWhichValuesChangedTheirState) {
    Simplex& plate = *agent.rig.tree.find("/plate");
    start();
    const EventMemory& memory = *agent.rig.outside.access.memory;
    bool high = false;
    EXPECT_TRUE(comesTrue([&] {
        high = !high;
        plate.data<double>("level") = high ? 9.0 : 1.0;
        agent.rig.step();
        const auto events = memory.page(0).events;
        return std::ranges::any_of(events, [](const KeptEvent& each) {
            return each.path == "/plate" && each.text == "level is outside its limits: 9";
        });
    }));
}

TEST_F(DdsAgent, SaysHowManyAgentsItHears) {
    const auto says = [&](std::uint64_t count) {
        return comesTrue([&] { return heard() && numberIn(*heard(), agentsHeard) == count; });
    };
    start();
    ASSERT_TRUE(tool.presences->write(tool.presence()));
    EXPECT_TRUE(says(1)) << "tools do not count";
    Presence other = tool.presence();
    other.name = "other";
    other.agent = agentId(other.name);
    other.role = "agent";
    EXPECT_TRUE(comesTrue([&] {
        tool.presences->write(other);
        return numberIn(*heard(), agentsHeard) == 2;
    }));
    EXPECT_TRUE(says(1)) << "it is lost";
}

TEST_F(DdsAgent, WritesAViewOnlyWhileSomebodyAsks) {
    Inbox<Block> blocks;
    const auto reader = tool.participant.reader<Block>(topics::view30, blocks.push());
    start();
    ASSERT_TRUE(tool.presences->write(tool.presence()));
    Interest wanted;
    wanted.views = {{30, {"/"}}};
    ASSERT_TRUE(tool.interests->write(tool.interest(wanted)));
    const auto alive = [&] {
        tool.presences->write(tool.presence());
        agent.rig.step();
        return true;
    };
    ASSERT_TRUE(comesTrue([&] { return alive() && blocks.elements().size() >= 3; }));
    const Block block = blocks.elements().back();

    EXPECT_EQ(block.agent, agentId("robot"));
    EXPECT_EQ(block.epoch, agent.structure().epoch);
    EXPECT_EQ(block.structureHash, heard()->structureHash);
    ASSERT_EQ(block.simplexes.size(), 2U);
    EXPECT_EQ(block.simplexes[0].index, 0U);
    EXPECT_EQ(block.simplexes[0].floats, std::vector{1.0});

    Inbox<Block> others;
    const auto other = tool.participant.reader<Block>(topics::viewEvery, others.push());
    wanted.views = {{0, {"/"}}};
    ASSERT_TRUE(tool.interests->write(tool.interest(wanted)));
    ASSERT_TRUE(comesTrue([&] { return alive() && !others.elements().empty(); }));
    // What was written before may still be under way, but nothing comes after it.
    EXPECT_TRUE(comesTrue([&] {
        const std::size_t before = blocks.elements().size(), said = tool.heard.elements().size();
        EXPECT_TRUE(
            comesTrue([&] { return alive() && tool.heard.elements().size() >= said + 10; }));
        return blocks.elements().size() == before;
    }));
}

TEST_F(DdsAgent, SaysHowManyMessagesItRefusedAndWhy) {
    start();
    EXPECT_EQ(textIn(*heard(), refusedMessages), "");
    Command lying = tool.command(agent.structure(), "/plate", "set");
    lying.link.front() ^= 1;
    ASSERT_TRUE(tool.commands->write(lying));

    EXPECT_TRUE(comesTrue(
        [&] { return textIn(*heard(), refusedMessages) == "1: a command with a wrong id"; }));
}

// A link or a tool that was cut off for a while goes on with the first sample that arrives again.
TEST_F(DdsAgent, KeepsItsEndpointsForAnAskerThatIsLost) {
    Inbox<Block> blocks;
    const auto reader = tool.participant.reader<Block>(topics::viewEvery, blocks.push());
    start();
    Interest wanted;
    wanted.views = {{0, {"/"}}};
    const auto comesMore = [&] {
        ASSERT_TRUE(tool.presences->write(tool.presence()));
        ASSERT_TRUE(tool.interests->write(tool.interest(wanted)));
        const std::size_t before = blocks.elements().size();
        ASSERT_TRUE(comesTrue([&] {
            agent.rig.step();
            return blocks.elements().size() > before;
        }));
    };
    comesMore();
    ASSERT_TRUE(tool.presences->write(tool.presence("stopping")));
    ASSERT_TRUE(comesTrue([&] {
        const std::size_t before = blocks.elements().size(), said = tool.heard.elements().size();
        EXPECT_TRUE(comesTrue([&] {
            agent.rig.step();
            return tool.heard.elements().size() > said;
        }));
        return blocks.elements().size() == before;
    }));

    EXPECT_EQ(reader->writers(), 1U);
    comesMore();
}

TEST_F(DdsAgent, ViewsOnlyWhatIsBelowThePrefixes) {
    Inbox<Block> blocks;
    const auto reader = tool.participant.reader<Block>(topics::viewEvery, blocks.push());
    agent.rig.tree.add("/plate-b", "Plate");
    agent.rig.tree.add("/plate/left", "Plate");
    agent.rig.tree.add("/plates", "Plate");
    start();
    Interest wanted;
    wanted.views = {{0, {"/plate"}}};
    ASSERT_TRUE(tool.interests->write(tool.interest(wanted)));
    ASSERT_TRUE(comesTrue([&] {
        tool.presences->write(tool.presence());
        agent.rig.step();
        return !blocks.elements().empty();
    }));

    const Block block = blocks.elements().back();
    std::vector<std::string> paths;
    for (const SimplexData& each : block.simplexes) {
        paths.push_back(agent.structure().simplexes[each.index].path);
    }
    EXPECT_EQ(paths, (std::vector<std::string>{"/plate", "/plate/left"}));
}

TEST_F(DdsAgent, IsSilentWhileAnotherStartOfItsNameWasThereFirst) {
    start();
    Presence other = *heard();
    ++other.epoch;
    other.extras.clear();
    ASSERT_TRUE(tool.presences->write(other));

    EXPECT_TRUE(agent.sees("/robot: another start of robot is heard"));
    EXPECT_TRUE(comesTrue([&] {
        return std::ranges::any_of(tool.heard.elements(),
                                   [](const auto& each) { return each.state == "silent"; });
    }));
    const EventMemory& memory = *agent.rig.outside.access.memory;
    const auto changes = [&] {
        return std::ranges::count(memory.page(0).events, EventKind::ValueChange, &KeptEvent::kind);
    };
    const auto before = changes();
    const std::size_t said = tool.heard.elements().size();
    EXPECT_TRUE(comesTrue([&] {
        tool.presences->write(other);
        agent.rig.tree.find("/plate")->data<double>("level") = agent.rig.tick.cycle % 2 * 9.0;
        agent.rig.step();
        return tool.heard.elements().size() > said;
    }));
    EXPECT_EQ(changes(), before) << "the other start is the one that is asked";
    agent.rig.agent->stop();
    const auto all = tool.heard.elements();
    EXPECT_TRUE(
        std::ranges::none_of(all, [](const auto& each) { return each.state == "stopping"; }));
}

TEST_F(DdsAgent, IsNotSilencedByATool) {
    start();
    Presence nameless = *heard();
    nameless.epoch += 1;
    nameless.role = "tool";
    ASSERT_TRUE(tool.presences->write(nameless));

    EXPECT_TRUE(comesTrue([&] { return agent.dds.rejected() == 1; })) << agent.dds.rejected();
    EXPECT_EQ(agent.dds.lastRejection(), "a tool uses our name");
    const std::int64_t cycle = agent.rig.tick.cycle + 1;
    agent.rig.step();
    EXPECT_TRUE(comesTrue([&] { return heard()->cycle == cycle; }));
}

TEST(DdsLoop, AllocatesNothingWhileItLinksIsViewedAndCommanded) {
    NetworkAgent near{"near"};
    NetworkAgent away{test::commandTypes(), "away", {.period = 1'000'000'000}};  // never stale
    near.rig.tree.relateRemote(near.rig.hand("/boss", "Boss"), "readings", "/far");
    near.rig.tree.add("/plate", "Plate");
    Simplex& far = away.rig.tree.add("/far", "Reading");
    near.rig.start();
    away.rig.start();
    RawTool tool{"operator"};
    tool.connect(2);
    Interest wanted;
    wanted.views = {{0, {"/"}}};
    ASSERT_TRUE(tool.interests->write(tool.interest(wanted)));
    std::uint64_t allocated = 0;
    double value = 0;
    for (std::size_t round = 1; round <= 20; ++round) {
        tool.presences->write(tool.presence());
        tool.commands->write(tool.command(near.structure(), "/plate", "set"));
        far.data<double>("a") = ++value;
        ASSERT_TRUE(comesTrue([&] {
            away.rig.step();
            const std::uint64_t before = toolkit::test::allocationCount();
            near.rig.step();
            allocated += toolkit::test::allocationCount() - before;
            return near.rig.get<double>("/far", "a") == value &&
                   tool.answers.elements().size() >= round;
        }));
    }

    EXPECT_EQ(allocated, 0U);
}

}  // namespace
}  // namespace cortex::comms
