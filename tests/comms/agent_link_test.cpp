// SPDX-License-Identifier: Apache-2.0
// Links between agents over real DDS on the loopback interface.
#include "comms/network_agent.hpp"

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

// Agent "near" links /far, which others have.
struct NearAgent : NetworkAgent {
    NearAgent() : NetworkAgent{"near"}, boss{rig.hand("/boss", "Boss")} {
        rig.tree.relateRemote(boss, "readings", "/far");
    }
    Quality quality() { return rig.agent->images().newest().quality("/far"); }
    double value() { return rig.get<double>("/far", "a"); }

    test::Hand& boss;
};

// Agent "away" has /far.
struct AwayAgent : NetworkAgent {
    explicit AwayAgent(TypeModel types = test::commandTypes(), const std::string& name = "away",
                       const std::string& type = "Reading")
        : NetworkAgent{std::move(types), name}, far{rig.tree.add("/far", type)} {
        if (far.type().isA("Reading")) {
            far.set("origin", Value{std::vector{1.0, 2.0, 3.0}});
            far.set("a", 1.0);
        }
    }
    void setValue(double value) { far.data<double>("a") = value; }

    Simplex& far;
};

bool linked(NearAgent& near, AwayAgent& away, double value) {
    away.setValue(value);
    return comesTrue([&] {
        away.rig.step();
        near.rig.step();
        return near.quality() == Quality::Good && near.value() == value;
    });
}

bool lost(NearAgent& near) {
    return comesTrue([&] {
        near.rig.step();
        return near.quality() == Quality::Lost;
    });
}

TEST(DdsLink, GoesLiveWithValueAndConstantsWhenTheReaderStartsFirst) {
    NearAgent near;
    near.rig.start();
    near.rig.step();
    EXPECT_EQ(near.quality(), Quality::Lost);
    AwayAgent away{test::commandTypes(), "away", "FineReading"};
    away.rig.start();

    ASSERT_TRUE(linked(near, away, 4.5));
    EXPECT_EQ(near.rig.agent->images().newest().value("/far", "origin"),
              (Value{std::vector{1.0, 2.0, 3.0}}));
    EXPECT_TRUE(near.rig.hasEvent("/far: linked"));
    EXPECT_TRUE(near.rig.hasEvent("/near: agent away was found"));
}

TEST(DdsLink, AnAgentThatReadsMorePathsThanItCouldAskForIsRefusedInWords) {
    NearAgent near;
    for (int i = 0; i < 600; ++i) {
        near.rig.tree.relateRemote(near.boss, "readings",
                                   "/" + std::string(120, 'a') + std::to_string(i));
    }
    try {
        near.rig.start();
        FAIL() << "it was not refused";
    } catch (const Error& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("near reads 601 simplexes of other agents"), text.npos) << text;
        EXPECT_NE(text.find("at most 64000 can be asked for"), text.npos) << text;
    }
}

TEST(DdsLink, GoesLiveWhenTheOwnerStartsFirst) {
    AwayAgent away;
    away.rig.start();
    away.rig.step();
    NearAgent near;
    near.rig.start();

    EXPECT_TRUE(linked(near, away, 4.5));
    EXPECT_TRUE(linked(near, away, 5.5));
    EXPECT_EQ(near.dds.rejected(), 0U) << near.dds.lastRejection();
    EXPECT_EQ(away.dds.rejected(), 0U) << away.dds.lastRejection();
}

TEST(DdsLink, CarriesEveryKindOfItem) {
    NearAgent near;
    AwayAgent away;
    near.rig.start();
    away.rig.start();
    away.far.data<std::int64_t>("count") = -7;
    away.far.data<std::string_view>("label") = "sixteen octets!!";
    away.far.data<bool>("on") = true;

    ASSERT_TRUE(linked(near, away, 2));
    EXPECT_EQ(near.rig.get<std::int64_t>("/far", "count"), -7);
    EXPECT_EQ(near.rig.get<std::string_view>("/far", "label"), "sixteen octets!!");
    EXPECT_TRUE(near.rig.get<bool>("/far", "on"));
}

// What was measured before its owner started: by a device, or by an agent that runs on.
TEST(DdsLink, AStampBeforeTheStartComesThroughWithItsAge) {
    NearAgent near;
    AwayAgent away;
    near.rig.start();
    away.rig.start();
    const std::uint32_t far = near.structure().find("/far");
    const auto age = [&] {
        return near.rig.tick.nominalTime - near.rig.agent->tables().live(far).state->time;
    };
    double value = 2;
    for (const std::int64_t stamp :
         {std::int64_t{-1}, std::int64_t{-3'600'000'000'000}, -(std::int64_t{1} << 59U)}) {
        away.far.slot().time = stamp;
        ASSERT_TRUE(linked(near, away, ++value)) << stamp << ": " << near.dds.lastRejection();
        EXPECT_GE(age(), std::min(-stamp, std::int64_t{1} << 56U)) << stamp;
        EXPECT_EQ(near.dds.rejected(), 0U) << near.dds.lastRejection();
    }
}

TEST(DdsLink, CarriesTextUpToItsFirstNulAndOctetsThatAreNoText) {
    NearAgent near;
    AwayAgent away;
    near.rig.start();
    away.rig.start();
    away.far.data<std::string_view>("label") = std::string_view{"a\xff\0b", 4};

    ASSERT_TRUE(linked(near, away, 2));
    EXPECT_EQ(near.rig.get<std::string_view>("/far", "label"), "a\xff");
}

TEST(DdsLink, IsStaleWhenItsOwnerStandsStill) {
    NearAgent near;
    AwayAgent away;
    near.rig.start();
    away.rig.start();
    ASSERT_TRUE(linked(near, away, 2));

    EXPECT_TRUE(comesTrue([&] {
        near.rig.step(4);
        return near.quality() == Quality::Stale;
    }));
    EXPECT_EQ(near.value(), 2);
}

TEST(DdsLink, IsLostWithItsAgentAndBackWithItsNextStart) {
    NearAgent near;
    near.rig.start();
    auto away = std::make_unique<AwayAgent>();
    away->rig.start();
    ASSERT_TRUE(linked(near, *away, 2));
    away.reset();

    ASSERT_TRUE(lost(near));
    EXPECT_TRUE(near.sees("/near: agent away is lost: it stopped"));
    EXPECT_TRUE(near.rig.hasEvent("/far: no fresh sample") || near.rig.hasEvent("/far: link lost"))
        << "whichever is noticed first";
    AwayAgent again;
    again.far.set("origin", Value{std::vector{7.0, 8.0, 9.0}});
    again.rig.start();

    ASSERT_TRUE(linked(near, again, 3));
    EXPECT_EQ(near.rig.agent->images().newest().value("/far", "origin"),
              (Value{std::vector{7.0, 8.0, 9.0}}));
}

TEST(DdsLink, ToAnotherTypeStaysLostWithAnEvent) {
    NearAgent near;
    AwayAgent away{test::commandTypes(), "away", "Plate"};
    near.rig.start();
    away.rig.start();

    EXPECT_TRUE(near.sees("/far: away: a Reading is needed, the other agent has a Plate"));
    EXPECT_EQ(near.quality(), Quality::Lost);
}

TEST(DdsLink, ToAContradictingTypeStaysLostWithAnEvent) {
    NearAgent near;
    AwayAgent away{changedTypes("Reading", [](DataItem& item) {
        if (item.name != "b") return;
        item.kind = Kind::Int;
        item.initial = Value{std::vector<std::int64_t>{0}};
    })};
    near.rig.start();
    away.rig.start();

    EXPECT_TRUE(near.sees("/far: away: Reading"));
    near.rig.step(10);
    EXPECT_EQ(near.quality(), Quality::Lost);
}

TEST(DdsLink, ToATypeWithACorrectedLimitIsLiveAndSaysTheDifference) {
    NearAgent near;
    AwayAgent away{changedTypes("Reading", [](DataItem& item) {
        if (item.name == "a") item.max = 100.0;
    })};
    near.rig.start();
    away.rig.start();

    EXPECT_TRUE(linked(near, away, 50));
    EXPECT_TRUE(near.rig.hasEvent("/far: away: Reading"));
}

TEST(DdsLink, OfTwoClaimsTheOlderStaysLinked) {
    NearAgent near;
    AwayAgent away;
    near.rig.start();
    away.rig.start();
    ASSERT_TRUE(linked(near, away, 2));
    AwayAgent second{test::commandTypes(), "second"};
    second.rig.start();
    second.setValue(99);

    EXPECT_TRUE(near.sees("/far: second claims it as well; away stays linked"));
    EXPECT_TRUE(linked(near, away, 3));
}

TEST(DdsLink, OfTwoClaimsTheOneThatRunsLongerIsLinkedWhateverTheirClocksSay) {
    AwayAgent away;
    away.rig.make();  // its epoch is the earlier one
    AwayAgent second{test::commandTypes(), "another"};
    second.rig.start();
    NearAgent near;
    near.rig.start();
    ASSERT_TRUE(linked(near, second, 2));
    away.rig.start();

    EXPECT_TRUE(near.sees("/far: away claims it as well; another stays linked"));
    EXPECT_TRUE(linked(near, second, 3));
}

}  // namespace
}  // namespace cortex::comms
