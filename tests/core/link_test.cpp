// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/make_structure.hpp"
#include "cortex/core/transport.hpp"

#include "core/xml_model.hpp"
#include "support/agent_rig.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace cortex {
namespace {

using test::AgentRig;
using test::Hand;

TypeLayout layoutOf(const TypeModel& types, const std::string& type) {
    SimplexTree tree{types};
    tree.add("/x", type);
    const auto structure = makeStructure("a", tree);
    TypeLayout layout = *structure->simplexes[0].layout;
    layout.type = &types.at(type);
    for (ItemLayout& item : layout.items) item.item = types.at(type).findData(item.item->name);
    return layout;
}

LinkBinding compiled(const TypeModel& ours, const std::string& wanted, const TypeModel& theirs,
                     const std::string& has) {
    return compileLink(layoutOf(ours, wanted), layoutOf(theirs, has), ours, theirs);
}

TypeModel model(const std::string& items) {
    return test::readTypes("<type name='R'>" + items +
                           "</type>"
                           "<type name='Child' extends='R'><data name='aa' kind='float'/></type>"
                           "<type name='Other'><data name='v' kind='float'/></type>")
        .files.types;
}

TEST(CompileLink, CopiesItemsByNameFromAChildsLayout) {
    const TypeModel types = test::commandTypes();
    const LinkBinding binding = compiled(types, "Reading", types, "FineReading");

    EXPECT_TRUE(binding.usable) << binding.findings.text();
    ASSERT_EQ(binding.constants.size(), 1U);
    EXPECT_EQ(binding.constants[0].length, 3U);
    std::size_t floats = 0;
    for (const auto& copy : binding.copies) floats += copy.kind == Kind::Float ? copy.length : 0;
    EXPECT_EQ(floats, 2U);
}

TEST(CompileLink, ItemsThatLieSideBySideAreOneCopy) {
    const TypeModel types = test::commandTypes();
    const LinkBinding binding = compiled(types, "Reading", types, "Reading");

    std::size_t floats = 0;
    for (const auto& copy : binding.copies) floats += copy.kind == Kind::Float ? 1 : 0;
    EXPECT_EQ(floats, 1U);
}

TEST(CompileLink, RefusesAnotherType) {
    const TypeModel types = model("<data name='v' kind='float'/>");
    const LinkBinding binding = compiled(types, "R", types, "Other");

    EXPECT_FALSE(binding.usable);
    ASSERT_EQ(binding.findings.findings.size(), 1U);
    EXPECT_EQ(binding.findings.findings[0].rule, "link-type");
}

TEST(CompileLink, RefusesAContradictionNamingTheItem) {
    const LinkBinding binding = compiled(model("<data name='v' kind='float'/>"), "R",
                                         model("<data name='v' kind='int'/>"), "R");

    EXPECT_FALSE(binding.usable);
    EXPECT_NE(binding.findings.text().find("v"), std::string::npos);
}

TEST(CompileLink, RefusesAConstantThatIsNoneThereForThatReason) {
    const LinkBinding binding = compiled(model("<data name='v' kind='float' constant='true'/>"),
                                         "R", model("<data name='v' kind='float'/>"), "R");

    EXPECT_FALSE(binding.usable);
    ASSERT_EQ(binding.findings.findings.size(), 1U) << binding.findings.text();
    EXPECT_EQ(binding.findings.findings[0].rule, "link-contradiction");
    EXPECT_NE(binding.findings.text().find("ours has constant=true"), std::string::npos)
        << binding.findings.text();
}

TEST(CompileLink, RefusesAMissingItem) {
    EXPECT_FALSE(compiled(model("<data name='v' kind='float'/><data name='w' kind='float'/>"), "R",
                          model("<data name='v' kind='float'/>"), "R")
                     .usable);
}

TEST(CompileLink, LinksADifferenceAndListsIt) {
    const LinkBinding binding = compiled(model("<data name='v' kind='float' max='1'/>"), "R",
                                         model("<data name='v' kind='float' max='2'/>"), "Child");

    EXPECT_TRUE(binding.usable);
    ASSERT_FALSE(binding.findings.findings.empty());
    EXPECT_EQ(binding.findings.findings[0].severity, Severity::Warning);
}

// The receiving side, with samples played by the test.
struct Link : testing::Test {
    AgentRig rig;
    Hand& boss = rig.hand("/boss", "Boss");
    std::vector<double> floats{1, 2};
    std::vector<std::int64_t> ints{7};
    bool bools[1] = {true};
    alignas(8) std::byte strings[StringCell::size(16)] = {};
    SlotState state{40, 40'000'000, noSimplex, Quality::Good};
    std::vector<double> origin{1, 2, 3};
    LinkBinding binding;
    std::uint32_t simplex = 0;

    void SetUp() override {
        rig.tree.relateRemote(boss, "readings", "/far");
        rig.start();
        const TypeModel& types = rig.tree.types();
        simplex = rig.agent->structure().find("/far");
        binding = compileLink(*rig.agent->structure().simplexes[simplex].layout,
                              layoutOf(types, "Reading"), types, types);
        auto* cell = reinterpret_cast<StringCell*>(strings);
        *cell = {16, 0, 0};
        cell->assign("far away");
    }
    void sample(std::int64_t age = 0) {
        rig.outside.atRead([this, age](Inbox& inbox) {
            inbox.link(simplex, binding, {ints.data(), floats.data(), bools, strings, &state}, age);
        });
        rig.step();
    }
    Quality quality() { return rig.agent->images().newest().quality("/far"); }
};

TEST_F(Link, IsLostUntilTheFirstSample) {
    rig.step();
    EXPECT_EQ(quality(), Quality::Lost);
    EXPECT_EQ(rig.agent->tables().live(simplex).state->cause, simplex);
}

TEST_F(Link, SampleIsCopiedWithItsQualityAndStampOnOurClock) {
    rig.step(9);
    sample(2'000'000);

    EXPECT_EQ(quality(), Quality::Good);
    EXPECT_EQ(rig.get<double>("/far", "a"), 1);
    EXPECT_EQ(rig.get<double>("/far", "b"), 2);
    EXPECT_EQ(rig.get<std::int64_t>("/far", "count"), 7);
    EXPECT_TRUE(rig.get<bool>("/far", "on"));
    EXPECT_EQ(rig.get<std::string_view>("/far", "label"), "far away");
    EXPECT_EQ(rig.agent->tables().live(simplex).state->time, 8'000'000);
    EXPECT_EQ(rig.agent->tables().live(simplex).state->cycle, 0) << "no cycle of ours";
    EXPECT_TRUE(rig.hasEvent("/far: linked"));
}

// A measurement from before our start, and one that many agents have passed on.
TEST_F(Link, AnAgeIsKeptHoweverLongUpToWhatNoChainOfAgentsCanOverflow) {
    constexpr std::int64_t year = std::int64_t{365} * 86'400 * 1'000'000'000;
    constexpr std::int64_t oldest = std::int64_t{1} << 56U;
    rig.step(9);
    for (const auto& [age, seen] : {std::pair{year, year},
                                    {oldest + 1, oldest},
                                    {std::numeric_limits<std::int64_t>::max(), oldest}}) {
        sample(age);
        EXPECT_EQ(rig.tick.nominalTime - rig.agent->tables().live(simplex).state->time, seen);
        EXPECT_EQ(quality(), Quality::Good) << "age alone makes no sample worse";
    }
}

TEST_F(Link, BadSampleIsBadHere) {
    state.quality = Quality::Bad;
    state.cause = 3;
    sample();

    EXPECT_EQ(quality(), Quality::Bad);
    EXPECT_EQ(rig.agent->tables().live(simplex).state->cause, simplex);
}

TEST_F(Link, IsStaleAfterThreeMissedPeriodsAndGoodAgainWithTheNextSample) {
    sample();
    rig.step(2);
    EXPECT_EQ(quality(), Quality::Good);
    rig.step();
    EXPECT_EQ(quality(), Quality::Stale);
    EXPECT_EQ(rig.agent->tables().live(simplex).state->time, 1'000'000);
    sample();

    EXPECT_EQ(quality(), Quality::Good);
}

TEST_F(Link, SaysThatItIsStaleAfterTwentyMissedPeriods) {
    sample();
    rig.step(19);
    EXPECT_FALSE(rig.hasEvent("/far: no fresh sample for 20 periods"));
    rig.step();
    EXPECT_TRUE(rig.hasEvent("/far: no fresh sample for 20 periods"));
}

TEST_F(Link, AStandstillOfItsOwnLoopIsNoSilenceOfTheOther) {
    sample();
    rig.tick.nominalTime += 500'000'000;
    rig.step();
    EXPECT_EQ(quality(), Quality::Stale);
    EXPECT_FALSE(rig.hasEvent("no fresh sample"));
    rig.step(20);
    EXPECT_TRUE(rig.hasEvent("no fresh sample")) << "it is silent indeed";
}

TEST_F(Link, OneLossIsOneEventUntilItIsBack) {
    const auto lose = [this] {
        rig.step(30);
        rig.outside.atRead([this](Inbox& inbox) { inbox.linkLost(simplex); });
        rig.step(30);
    };
    const auto told = [this] {
        return std::ranges::count_if(rig.events(), [](const std::string& each) {
            return each.find("no fresh sample") != each.npos || each.find("lost") != each.npos;
        });
    };
    sample();
    lose();
    EXPECT_EQ(told(), 1);
    sample();
    lose();
    EXPECT_EQ(told(), 2);
}

TEST_F(Link, WhatHasNeverBeenThereIsWaitedForAfterASecondAndOnce) {
    rig.step(999);
    EXPECT_FALSE(rig.hasEvent("waits for"));
    rig.step(5'000);
    const std::string line = "/rig: waits for /far, which no other agent has offered yet";
    EXPECT_EQ(std::ranges::count(rig.events(), line), 1);
}

TEST_F(Link, WhatIsLinkedWithoutAValueIsNotSaidToBeMissing) {
    rig.outside.atRead([this](Inbox& inbox) { inbox.linkOffered(simplex); });
    rig.step(1'001);

    EXPECT_TRUE(rig.hasEvent("/rig: waits for /far: linked, but no value has come"));
    EXPECT_FALSE(rig.hasEvent("offered"));
}

TEST_F(Link, WhatIsThereWithinASecondIsNotWaitedFor) {
    rig.step(500);
    sample();
    rig.step(1'000);
    EXPECT_FALSE(rig.hasEvent("waits for"));
}

TEST_F(Link, StalenessDoesNotMakeABadSampleBetter) {
    state.quality = Quality::Bad;
    sample();
    rig.step(10);

    EXPECT_EQ(quality(), Quality::Bad);
}

TEST_F(Link, IsLostWithItsAgentAndBack) {
    sample();
    rig.outside.atRead([this](Inbox& inbox) { inbox.linkLost(simplex); });
    rig.step(5);
    EXPECT_EQ(quality(), Quality::Lost);
    EXPECT_TRUE(rig.hasEvent("/far: link lost"));
    sample();

    EXPECT_EQ(quality(), Quality::Good);
}

TEST_F(Link, ConstantsComeOnce) {
    rig.outside.atRead([this](Inbox& inbox) {
        inbox.linkConstants(simplex, binding, {nullptr, origin.data(), nullptr, nullptr, nullptr});
    });
    rig.step();

    EXPECT_EQ(rig.agent->images().newest().value("/far", "origin"), Value{origin});
}

TEST_F(Link, WhatIsNoLinkOrNotUsableIsIgnored) {
    binding.usable = false;
    sample();
    EXPECT_EQ(quality(), Quality::Lost);
    binding.usable = true;
    simplex = boss.index();
    sample();
    rig.outside.atRead([this](Inbox& inbox) {
        inbox.linkConstants(simplex, binding, {});
        inbox.linkLost(simplex);
    });
    rig.step();

    EXPECT_EQ(quality(), Quality::Lost);
}

TEST_F(Link, IsStaleAfterThreePeriodsOfItsOwnerWhereThatIsSlower) {
    binding.period = 10'000'000;  // ours is 1 ms
    sample();
    rig.step(29);
    EXPECT_EQ(quality(), Quality::Good);
    EXPECT_EQ(rig.agent->ownerPeriod(simplex), 10'000'000);
    rig.step();
    EXPECT_EQ(quality(), Quality::Stale);
}

}  // namespace
}  // namespace cortex
