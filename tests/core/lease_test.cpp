// SPDX-License-Identifier: Apache-2.0
#include "agent/lease.hpp"

#include "support/agent_rig.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex {
namespace {

using test::AgentRig;
using test::Hand;
using test::PlayedInterface;

Value text(const std::string& value) { return Value{std::vector{value}}; }

// Two tools, desk and hall, before the simplexes /arm, /arm/axis and /army. 10 ms a cycle.
struct Control : testing::Test {
    explicit Control(bool required = false)
        : rig{"rig", {.controlRequired = required, .period = 10'000'000}} {}

    AgentRig rig;
    Hand& arm = rig.hand("/arm", "Holding");
    Hand& axis = rig.hand("/arm/axis", "Careful");
    Hand& army = rig.hand("/army");
    std::map<std::string, std::uint64_t> sequences;
    std::map<std::string, std::string> people;  // on whose behalf senders command
    int calls = 0;

    void SetUp() override {
        rig.make();
        for (Hand* hand : {&arm, &axis, &army}) {
            hand->on("poke", [this](Call&) { return ++calls, Outcome::Done; });
            hand->on("rest", [](Call&) { return Outcome::Done; });
            hand->on("watch", [](Call&) { return Outcome::Running; });
        }
        rig.start();
    }
    PlayedInterface::Answer ask(const std::string& sender, const std::string& path,
                                const std::string& command,
                                const ProgramInterface::Arguments& arguments = {}) {
        rig.outside.send({.path = path,
                          .command = command,
                          .arguments = arguments,
                          .sender = sender,
                          .sequence = ++sequences[sender],
                          .answeredBelow = sequences[sender],
                          .onBehalfOf = people[sender]});
        rig.step();
        return rig.outside.last();
    }
    PlayedInterface::Answer take(const std::string& sender, const std::string& prefix) {
        return ask(sender, "/rig", "takeControl", {{"prefix", text(prefix)}});
    }
    PlayedInterface::Answer renew(const std::string& sender, const std::string& prefix) {
        return ask(sender, "/rig", "renewControl", {{"prefix", text(prefix)}});
    }
    std::string shown(const char* item, std::size_t place = 0) {
        const Value value = rig.agent->images().newest().value("/rig", item);
        return std::get<std::vector<std::string>>(value)[place];
    }
};

struct RequiredControl : Control {
    RequiredControl() : Control{true} {}
};

TEST_F(Control, WithoutALeaseCommandsAreOpen) {
    EXPECT_EQ(ask("desk", "/arm", "poke").outcome, Outcome::Done);
}

TEST_F(Control, HolderCommandsAndOthersAreRefusedInWords) {
    EXPECT_EQ(take("desk", "/arm").outcome, Outcome::Done);

    EXPECT_EQ(ask("desk", "/arm/axis", "poke").outcome, Outcome::Done);
    const auto other = ask("hall", "/arm/axis", "poke");
    EXPECT_EQ(other.outcome, Outcome::Rejected);
    EXPECT_EQ(other.reason, Reason::Authority);
    EXPECT_EQ(other.why, "/arm is held by desk");
    EXPECT_EQ(ask("hall", "/army", "poke").outcome, Outcome::Done);
    EXPECT_EQ(calls, 2);
}

TEST_F(Control, ShutdownAndCancelNeedNone) {
    take("desk", "/");
    rig.setState(army, State::Active);

    EXPECT_EQ(ask("hall", "/army", "shutdown").outcome, Outcome::Running);
    EXPECT_EQ(ask("hall", "/arm", "cancel").reason, Reason::State);  // only: nothing runs
    EXPECT_EQ(ask("hall", "/army", "poke").reason, Reason::Authority);
}

TEST_F(Control, IsShownAsDataOfTheAgent) {
    take("desk", "/arm");
    take("hall", "/army");

    EXPECT_EQ(shown("leasePrefix", 0), "/arm");
    EXPECT_EQ(shown("leaseHolder", 0), "desk");
    EXPECT_EQ(shown("leasePrefix", 1), "/army");
    EXPECT_EQ(shown("leaseHolder", 1), "hall");
    const Value since = rig.agent->images().newest().value("/rig", "leaseSince");
    EXPECT_EQ(std::get<std::vector<std::int64_t>>(since)[1], 2);
}

TEST_F(Control, OverlappingPrefixesOfTwoAgentsAreRefused) {
    take("desk", "/arm/axis");

    EXPECT_EQ(take("hall", "/arm").reason, Reason::Authority);
    EXPECT_EQ(take("hall", "/arm/axis").reason, Reason::Authority);
    EXPECT_EQ(take("hall", "/").reason, Reason::Authority);
    EXPECT_EQ(take("hall", "/army").outcome, Outcome::Done);
    EXPECT_EQ(take("desk", "/arm").outcome, Outcome::Done);  // one's own may grow
}

TEST_F(Control, PrefixMustLeadToSomething) {
    const auto answer = take("desk", "/nothing");

    EXPECT_EQ(answer.reason, Reason::Range);
    EXPECT_EQ(answer.why, "no simplex below /nothing");
}

TEST_F(Control, EightLeasesAreAllThatCanBeHeld) {
    for (int i = 0; i < 8; ++i) {
        EXPECT_EQ(take("desk", i % 2 == 0 ? "/arm" : "/army").outcome, Outcome::Done);
    }
    EXPECT_EQ(shown("leasePrefix", 2), "");  // taking again is no second lease
}

TEST_F(Control, ARenewalIsAnEventOnlyIfItIsRefused) {
    take("desk", "/army");
    EXPECT_EQ(renew("desk", "/army").outcome, Outcome::Done);
    EXPECT_TRUE(rig.hasEvent("takeControl"));
    EXPECT_FALSE(rig.hasEvent("renewControl"));

    EXPECT_EQ(renew("hall", "/army").reason, Reason::Authority);
    EXPECT_TRUE(rig.hasEvent("renewControl"));
}

TEST_F(Control, IsLostTwoSecondsAfterTheLastRenewal) {
    take("desk", "/army");
    rig.step(150);
    EXPECT_EQ(renew("desk", "/army").outcome, Outcome::Done);
    rig.step(199);
    EXPECT_EQ(ask("hall", "/army", "poke").reason, Reason::Authority);
    rig.step(1);

    EXPECT_EQ(ask("hall", "/army", "poke").outcome, Outcome::Done);
    EXPECT_EQ(shown("leasePrefix"), "");
    EXPECT_TRUE(
        rig.hasEvent("/rig: desk no longer has control of /army: it was not renewed for 2 s"));
    EXPECT_EQ(renew("desk", "/army").reason, Reason::Authority);
}

TEST_F(Control, LosingItMeansWhatTheTypeSays) {
    take("desk", "/arm");
    EXPECT_EQ(ask("desk", "/arm", "watch").outcome, Outcome::Running);
    EXPECT_EQ(ask("desk", "/army", "watch").outcome, Outcome::Running);
    rig.step(205);

    EXPECT_EQ(rig.agent->takeLifeCycle(axis.index(), rig.agent->thread(0)),
              LifeCycle::Shutdown);  // onLeaseLost=shutdown
    EXPECT_EQ(rig.agent->takeLifeCycle(arm.index(), rig.agent->thread(0)), LifeCycle::None);
    EXPECT_EQ(rig.outside.last().outcome, Outcome::Cancelled);  // hold: its long command ends
    EXPECT_EQ(rig.outside.last().why, "control was lost");
    EXPECT_EQ(rig.outside.answers.size(), 4U);  // continue: /army goes on
}

TEST_F(Control, IsLostWithItsHolder) {
    take("desk", "/arm");
    take("desk", "/army");
    rig.outside.loseSender("desk");
    rig.step();

    EXPECT_EQ(take("hall", "/").outcome, Outcome::Done);
    EXPECT_TRUE(rig.hasEvent("desk no longer has control of /arm: it is gone"));
}

TEST_F(Control, IsLostWhenItsHolderStartsAnew) {
    take("desk", "/arm");
    rig.outside.send({.path = "/army", .command = "poke", .sender = "desk", .epoch = 2});
    rig.step();

    EXPECT_EQ(take("hall", "/arm").outcome, Outcome::Done);
}

TEST_F(Control, IsHandedOverAndRenewedByTheNewHolder) {
    take("desk", "/arm");
    rig.step(100);
    const ProgramInterface::Arguments toHall{{"prefix", text("/arm")}, {"to", text("hall")}};
    EXPECT_EQ(ask("hall", "/rig", "handOverControl", toHall).reason, Reason::Authority);
    EXPECT_EQ(ask("desk", "/rig", "handOverControl", toHall).outcome, Outcome::Done);

    EXPECT_EQ(ask("hall", "/arm", "poke").outcome, Outcome::Done);
    EXPECT_EQ(ask("desk", "/arm", "poke").reason, Reason::Authority);
    EXPECT_EQ(shown("leaseHolder"), "hall");
    rig.step(190);
    EXPECT_EQ(renew("hall", "/arm").outcome, Outcome::Done);
    rig.step(190);
    EXPECT_EQ(shown("leaseHolder"), "hall");
}

TEST_F(Control, HandedOverIsNotLostWithAnEarlierStartOfItsNewHolder) {
    take("desk", "/arm");
    ask("desk", "/rig", "handOverControl", {{"prefix", text("/arm")}, {"to", text("hall")}});
    rig.outside.loseSender("hall", 1);
    rig.step();

    EXPECT_EQ(shown("leaseHolder"), "hall");
}

TEST_F(Control, IsHandedOverWithAllBelowAndNotFromBelowAWiderOne) {
    take("desk", "/arm/axis");
    take("desk", "/arm");
    const auto give = [&](const char* prefix) {
        return ask("desk", "/rig", "handOverControl",
                   {{"prefix", text(prefix)}, {"to", text("hall")}});
    };
    EXPECT_EQ(give("/arm/axis").why, "it holds /arm too: hand that over, or release it first");
    EXPECT_EQ(give("/arm").outcome, Outcome::Done);

    EXPECT_EQ(shown("leaseHolder", 0), "hall");
    EXPECT_EQ(shown("leaseHolder", 1), "hall");
    EXPECT_EQ(ask("hall", "/arm/axis", "poke").outcome, Outcome::Done);
}

TEST_F(Control, TellsOnWhoseBehalfItIsHeldWhereItIsRefusedToOthersAndWhereItIsLost) {
    people["desk"] = "alice@desk";
    take("desk", "/arm");
    EXPECT_EQ(ask("hall", "/arm/axis", "poke").why, "/arm is held by desk for alice@desk");
    EXPECT_EQ(take("hall", "/").why, "/arm is held by desk for alice@desk");
    people["desk"] = "bob";
    renew("desk", "/arm");
    EXPECT_EQ(take("hall", "/").why, "/arm is held by desk for bob") << "who renewed it last";

    rig.outside.loseSender("desk");
    rig.step();
    EXPECT_TRUE(rig.hasEvent("/rig: desk for bob no longer has control of /arm: it is gone"));
}

TEST_F(Control, HandedOverIsOnBehalfOfWhoRenewsItAndUntilThenOfNobody) {
    people = {{"desk", "alice"}, {"hall", "bob"}};
    take("desk", "/arm");
    ask("desk", "/rig", "handOverControl", {{"prefix", text("/arm")}, {"to", text("hall")}});
    EXPECT_EQ(ask("desk", "/arm", "poke").why, "/arm is held by hall");

    renew("hall", "/arm");
    EXPECT_EQ(ask("desk", "/arm", "poke").why, "/arm is held by hall for bob");
    rig.step(210);
    EXPECT_TRUE(rig.hasEvent("hall for bob no longer has control of /arm: it was not renewed"));
}

TEST_F(Control, HandedOverAndNeverRenewedIsLostWithoutThePersonBefore) {
    people["desk"] = "alice";
    take("desk", "/arm");
    ask("desk", "/rig", "handOverControl", {{"prefix", text("/arm")}, {"to", text("hall")}});
    rig.step(210);

    EXPECT_TRUE(rig.hasEvent("/rig: hall no longer has control of /arm: it was not renewed"));
}

TEST_F(Control, IsHandedOverToANameOnly) {
    take("desk", "/arm");
    EXPECT_EQ(
        ask("desk", "/rig", "handOverControl", {{"prefix", text("/arm")}, {"to", text("")}}).reason,
        Reason::Range);
}

TEST_F(Control, IsReleased) {
    take("desk", "/arm");
    EXPECT_EQ(ask("hall", "/rig", "releaseControl", {{"prefix", text("/arm")}}).reason,
              Reason::Authority);
    EXPECT_EQ(ask("desk", "/rig", "releaseControl", {{"prefix", text("/arm")}}).outcome,
              Outcome::Done);

    EXPECT_EQ(ask("hall", "/arm", "poke").outcome, Outcome::Done);
    EXPECT_EQ(shown("leasePrefix"), "");
}

TEST_F(RequiredControl, CommandsNeedALease) {
    const auto answer = ask("desk", "/arm", "poke");
    EXPECT_EQ(answer.reason, Reason::Authority);
    EXPECT_EQ(answer.why, "control is required: take it first");
    EXPECT_EQ(take("desk", "/").outcome, Outcome::Done);

    EXPECT_EQ(ask("desk", "/arm", "poke").outcome, Outcome::Done);
    rig.setState(army, State::Active);
    EXPECT_EQ(ask("hall", "/army", "shutdown").outcome, Outcome::Running);
}

TEST_F(RequiredControl, WhatOnlyStopsNeedsNoneWhereNobodyElseHasIt) {
    EXPECT_EQ(ask("hall", "/arm", "rest").outcome, Outcome::Done);
    EXPECT_EQ(take("desk", "/arm").outcome, Outcome::Done);

    EXPECT_EQ(ask("hall", "/arm", "rest").why, "/arm is held by desk");
    EXPECT_EQ(ask("desk", "/arm", "rest").outcome, Outcome::Done);
    EXPECT_EQ(ask("hall", "/army", "rest").outcome, Outcome::Done);
}

// A command with a prefix to the agent goes to everything below it.
TEST(GroupControl, CommandToTheAgentNeedsWhatItsPrefixCovers) {
    AgentRig rig{"rig"};
    rig.tree.add("/rig", "Cluster");
    rig.hand("/arm");
    rig.hand("/arm/axis");
    rig.hand("/army");
    rig.make();
    const std::uint32_t agent = rig.agent->agentSimplex();
    int calls = 0;
    rig.agent->registerHandler(agent, "startup", {&calls, [](void* count, Call&) {
                                                      ++*static_cast<int*>(count);
                                                      return Outcome::Done;
                                                  }});
    rig.start();
    std::uint64_t sequence = 0;
    const auto ask = [&](const std::string& sender, const std::string& command,
                         const std::string& prefix) {
        rig.outside.send({.path = "/rig",
                          .command = command,
                          .arguments = {{"prefix", text(prefix)}},
                          .sender = sender,
                          .sequence = ++sequence,
                          .answeredBelow = sequence});
        rig.step();
        return rig.outside.last();
    };
    EXPECT_EQ(ask("desk", "takeControl", "/arm/axis").outcome, Outcome::Done);

    EXPECT_EQ(ask("hall", "startup", "/").reason, Reason::Authority);
    EXPECT_EQ(ask("hall", "startup", "/arm").reason, Reason::Authority);
    EXPECT_EQ(ask("hall", "startup", "/army").outcome, Outcome::Done);
    EXPECT_EQ(ask("desk", "startup", "/").outcome, Outcome::Done);
    EXPECT_EQ(calls, 2);
}

// Along a relationship nobody takes control.
TEST(InnerControl, IsForThoseOutside) {
    AgentRig rig;
    rig.tree.add("/rig", "Agent");
    Hand& boss = rig.hand("/boss", "Boss");
    rig.tree.relate(boss, "agent", rig.tree.at("/rig"));
    rig.make();
    auto take = boss.input("agent").command("takeControl");
    auto renew = boss.input("agent").command("renewControl");
    take.argument<std::string_view>("prefix") = "/";
    renew.argument<std::string_view>("prefix") = "/";
    rig.start();
    boss.run = [&] {
        take.send();
        renew.send();
        boss.run = nullptr;
    };
    rig.step(2);

    EXPECT_EQ(take.answer().reason, Reason::Authority);
    EXPECT_EQ(renew.answer().reason, Reason::Authority);
}

}  // namespace
}  // namespace cortex
