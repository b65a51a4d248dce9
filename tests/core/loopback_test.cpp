// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/loopback.hpp"

#include "cortex/core/error.hpp"

#include "core/xml_model.hpp"
#include "support/agent_rig.hpp"

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace cortex {
namespace {

using test::AgentRig;
using test::Hand;

// Agent "near" links /far of agent "away", a gateway of descriptive simplexes.
struct Loopback : testing::Test {
    LoopbackHub hub;
    std::unique_ptr<CommunicationInterface> nearInterface = hub.makeInterface();
    std::unique_ptr<CommunicationInterface> awayInterface = hub.makeInterface();
    AgentRig near{"near"}, away{"away"};
    Hand& boss = near.hand("/boss", "Boss");
    Simplex& far = away.tree.add("/far", "FineReading");
    Simplex& plate = away.tree.add("/plate", "Plate");

    Loopback() {
        near.tree.relateRemote(boss, "readings", "/far");
        near.add(*nearInterface);
        away.add(*awayInterface);
        far.set("origin", Value{std::vector{1.0, 2.0, 3.0}});
    }
    void start() {
        near.start();
        away.start();
    }
    void step(int cycles = 1) {
        for (int i = 0; i < cycles; ++i) {
            away.step();
            near.step();
        }
    }
    Quality quality() { return near.agent->images().newest().quality("/far"); }
    CallResult answer(const std::string& sender, std::uint64_t number) {
        CallResult result;
        for (int i = 0; i < 10 && !hub.poll(sender, number, result); ++i) step();
        return result;
    }
};

TEST_F(Loopback, LinkIsBoundWhicheverAgentStartsFirst) {
    near.start();
    near.step(2);
    EXPECT_EQ(quality(), Quality::Lost);
    away.start();
    far.data<double>("a") = 4.5;
    step();

    EXPECT_EQ(quality(), Quality::Good);
    EXPECT_EQ(near.get<double>("/far", "a"), 4.5);
    EXPECT_EQ(near.agent->images().newest().value("/far", "origin"),
              (Value{std::vector{1.0, 2.0, 3.0}}));
    EXPECT_TRUE(near.hasEvent("/far: linked"));
}

TEST_F(Loopback, ValuesFollowAndAgeWithoutNewOnes) {
    start();
    far.data<double>("b") = 1;
    step();
    far.data<double>("b") = 2;
    step();
    EXPECT_EQ(near.get<double>("/far", "b"), 2);
    near.step(3);  // the other agent stands still

    EXPECT_EQ(quality(), Quality::Stale);
}

TEST_F(Loopback, LinkIsLostWithTheConnectionAndBack) {
    start();
    step();
    hub.setConnected("away", false);
    step();
    EXPECT_EQ(quality(), Quality::Lost);
    hub.setConnected("away", true);
    step();
    EXPECT_EQ(quality(), Quality::Good);
    hub.setConnected("near", false);
    step();
    EXPECT_EQ(quality(), Quality::Lost);
}

TEST_F(Loopback, LinkIsLostWhenItsAgentStops) {
    start();
    step();
    away.agent->stop();
    near.step();

    EXPECT_EQ(quality(), Quality::Lost);
}

TEST_F(Loopback, PathOfAnotherTypeStaysLostWithAnEvent) {
    AgentRig wrong{"wrong"};
    auto interface = hub.makeInterface();
    wrong.tree.add("/far", "Plate");
    wrong.add(*interface);
    near.start();
    wrong.start();
    wrong.step();
    near.step();

    EXPECT_EQ(quality(), Quality::Lost);
    EXPECT_TRUE(near.hasEvent("/far: a Reading is needed, the other agent has a Plate"));
    wrong.agent->stop();
}

TEST_F(Loopback, ContradictionStaysLostWithAnEvent) {
    TypeModel types = test::commandTypes();
    auto declarations = types.declarations();
    for (DataItem& item : declarations.at("Reading").data) {
        if (item.name == "a") item.kind = Kind::Int;
        if (item.name == "a") item.initial = Value{std::vector<std::int64_t>{0}};
    }
    std::vector<TypeDeclaration> changed;
    for (auto& [name, declaration] : declarations) {
        for (DataItem& item : declaration.data) {
            if (name == "Reading" && item.name == "a") item.safe = {Safe::Kind::Hold, {}};
        }
        changed.push_back(declaration);
    }
    Report report;
    AgentRig other{TypeModel::build(std::move(changed), report), "other"};
    ASSERT_TRUE(report.ok()) << report.text();
    auto interface = hub.makeInterface();
    other.tree.add("/far", "Reading");
    other.add(*interface);
    near.start();
    other.start();
    other.step();
    near.step();

    EXPECT_EQ(quality(), Quality::Lost);
    bool named = false;
    for (const auto& text : near.events()) {
        named = named || (text.starts_with("/far: ") && text.find("Reading") != std::string::npos);
    }
    EXPECT_TRUE(named);
    other.agent->stop();
}

TEST_F(Loopback, PathOfTwoAgentsStaysLinkedToTheOlderClaim) {
    start();
    AgentRig second{"second"};
    auto interface = hub.makeInterface();
    second.tree.add("/far", "Reading").set("a", 99.0);
    second.add(*interface);
    second.start();
    second.step();
    step();

    EXPECT_EQ(near.get<double>("/far", "a"), 0);
    EXPECT_TRUE(near.hasEvent("/far: second claims it as well; away stays linked"));
    second.agent->stop();
}

TEST_F(Loopback, CommandGoesAcrossAndItsAnswerBack) {
    start();
    step();
    const auto number =
        hub.post("near", "/plate", "set", {{"level", Value{std::vector{2.5}}}}, 100);
    const CallResult result = answer("near", number);

    EXPECT_TRUE(result.done()) << result.text();
    EXPECT_EQ(plate.data<double>("level"), 2.5);
    CallResult again;
    EXPECT_FALSE(hub.poll("near", number, again));
    EXPECT_TRUE(away.hasEvent("set(level=2.5): Done"));
}

TEST_F(Loopback, CommandThatIsReadTooLateIsExpired) {
    start();
    step();
    const auto number = hub.post("tool", "/plate", "set", {{"level", Value{std::vector{2.0}}}}, -1);

    EXPECT_EQ(answer("tool", number).outcome, Outcome::Expired);
    EXPECT_EQ(plate.data<double>("level"), 1);
}

TEST_F(Loopback, CommandToWhatNobodyHasOrHearsThrows) {
    start();
    EXPECT_THROW(hub.post("tool", "/plaet", "set", {}, 10), Error);
    hub.setConnected("away", false);
    EXPECT_THROW(hub.post("tool", "/plate", "set", {}, 10), Error);
}

TEST_F(Loopback, CommandOnItsWayWhenItsAgentIsCutOffIsUnknown) {
    start();
    const auto number = hub.post("tool", "/plate", "set", {{"level", Value{std::vector{2.0}}}}, 10);
    hub.setConnected("away", false);
    step();

    EXPECT_EQ(answer("tool", number).outcome, Outcome::Unknown);
}

TEST_F(Loopback, CommandOnItsWayWhenItsAgentStopsIsUnknown) {
    start();
    const auto number = hub.post("tool", "/plate", "set", {{"level", Value{std::vector{2.0}}}}, 10);
    away.agent->stop();

    EXPECT_EQ(answer("tool", number).outcome, Outcome::Unknown);
}

TEST_F(Loopback, LostToolLosesItsControl) {
    start();
    const Value all{std::vector<std::string>{"/"}};
    EXPECT_TRUE(
        answer("tool", hub.post("tool", "/away", "takeControl", {{"prefix", all}}, 10)).done());
    hub.setConnected("tool", false);
    step();
    EXPECT_TRUE(away.hasEvent("tool no longer has control of /"));
    EXPECT_THROW(hub.post("tool", "/plate", "set", {}, 10), Error);

    hub.setConnected("tool", true);
    EXPECT_NO_THROW(hub.post("tool", "/plate", "set", {}, 10));
}

TEST_F(Loopback, WhatNobodyPostedHasNoAnswer) {
    start();
    CallResult result;
    EXPECT_FALSE(hub.poll("tool", 1, result));
    hub.post("tool", "/plate", "set", {}, 10);
    EXPECT_FALSE(hub.poll("tool", 17, result));
}

TEST_F(Loopback, AgentsOnThreadsOfTheirOwnLinkCommandAndStop) {
    start();
    std::atomic<bool> stop{false};
    std::thread awayLoop{[&] {
        while (!stop) away.step();
    }};
    std::thread nearLoop{[&] {
        while (near.tick.cycle < 300) near.step();
    }};
    CallResult result;
    for (int i = 0; i < 20; ++i) {
        const auto number =
            hub.post("tool", "/plate", "set", {{"level", Value{std::vector{2.0}}}}, 3'000'000);
        while (!hub.poll("tool", number, result)) std::this_thread::yield();
        EXPECT_TRUE(result.done()) << result.text();
    }
    stop = true;
    awayLoop.join();
    away.agent->stop();
    nearLoop.join();

    near.step();
    EXPECT_EQ(quality(), Quality::Lost);
}

}  // namespace
}  // namespace cortex
