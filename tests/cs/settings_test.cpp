// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/error.hpp"

#include "support/safe_plant.hpp"

#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

namespace cortex::test {

namespace {

// gain may not be greater than limit; both say what they are and what they would be.
class Settings : public testing::Test {
protected:
    Settings() {
        probe.onPopulate = [this](Probe& self) {
            gain = self.data<const double>("gain");
            limit = self.data<const std::int64_t>("limit");
        };
        probe.onProposed = [this](Probe&, ProposedSettings& proposed) {
            ++asked;
            before = gain;
            after = proposed[gain];
            if (proposed[gain] > static_cast<double>(proposed[limit]))
                proposed.refuse("gain is above limit");
        };
        probe.onChanged = [this](Probe&) { told = gain; };
    }

    ProbeCluster cluster;
    Probe& probe = cluster.probe("/a");
    Data<const double> gain;
    Data<const std::int64_t> limit;
    int asked = 0;
    double before = 0, after = 0, told = 0;
};

TEST_F(Settings, AreSeenAsTheyAreAndAsTheyWouldBeAndToldAfterwards) {
    cluster.start();

    const CallResult result = cluster.call("/a", "set", {{"gain", 4.0}});

    EXPECT_EQ(result.outcome, Outcome::Done) << result.text();
    EXPECT_EQ(before, 1);
    EXPECT_EQ(after, 4);
    EXPECT_EQ(told, 4);
    EXPECT_EQ(cluster.number("/a", "gain"), 4);
}

TEST_F(Settings, ThatDoNotStandTogetherAreRefusedWithTheReasonOfTheSimplex) {
    cluster.start();

    const CallResult result = cluster.call("/a", "set", {{"gain", 7.0}});

    EXPECT_EQ(result.outcome, Outcome::Rejected);
    EXPECT_EQ(result.why, "gain is above limit");
    EXPECT_EQ(cluster.number("/a", "gain"), 1);
    EXPECT_EQ(told, 0);
    EXPECT_EQ(cluster.state("/a"), State::Standby);
}

TEST_F(Settings, OfOneRequestAreJudgedTogether) {
    cluster.start();

    EXPECT_EQ(cluster.call("/a", "set", {{"gain", 7.0}, {"limit", std::int64_t{8}}}).outcome,
              Outcome::Done);
    const CallResult result = cluster.call("/a", "set", {{"limit", std::int64_t{6}}});

    EXPECT_EQ(result.why, "gain is above limit");
    EXPECT_EQ(cluster.integer("/a", "limit"), 8);
}

TEST_F(Settings, OutOfTheRangeOfTheTypeAreNotEvenProposed) {
    cluster.start();
    const int atStart = asked;

    EXPECT_EQ(cluster.call("/a", "set", {{"gain", 11.0}}).reason, Reason::Range);

    EXPECT_EQ(atStart, 1);
    EXPECT_EQ(asked, 1);
}

TEST_F(Settings, ToBeginWithAreJudgedBeforeTheClusterStarts) {
    probe.set("gain", 9.0);

    try {
        cluster.start();
        FAIL() << "it started";
    } catch (const ModelError& error) {
        ASSERT_EQ(error.report().findings.size(), 1U);
        EXPECT_EQ(error.report().findings[0].rule, "settings-refused");
        EXPECT_EQ(error.report().findings[0].path, "/a");
        EXPECT_NE(std::string{error.what()}.find("gain is above limit"), std::string::npos);
    }
}

TEST_F(Settings, AreNotAppliedWhereTheHookThrowsNorWhileItMayNotRun) {
    cluster.start();
    probe.onProposed = [](Probe&, ProposedSettings&) { throw std::runtime_error("a slip"); };

    EXPECT_EQ(cluster.call("/a", "set", {{"limit", std::int64_t{7}}}).outcome, Outcome::Failed);
    EXPECT_EQ(cluster.state("/a"), State::Fault);
    const CallResult dead = cluster.call("/a", "set", {{"limit", std::int64_t{7}}});

    EXPECT_EQ(dead.reason, Reason::State);
    EXPECT_EQ(dead.why, "one of its hooks threw: clearFaults comes first");
    EXPECT_EQ(cluster.integer("/a", "limit"), 5);
}

TEST_F(Settings, OfArraysTextsAndBoolsAreSeenElementByElement) {
    Probe& settled = cluster.probe("/settled", "SettledProbe");
    std::span<const double> pose;
    TextArray<const std::string_view> names;
    Data<const bool> on;
    settled.onPopulate = [&](Probe& self) {
        pose = self.array<const double>("pose");
        names = self.array<const std::string_view>("names");
        on = self.data<const bool>("on");
    };
    std::string seen;
    settled.onProposed = [&](Probe&, ProposedSettings& proposed) {
        seen = toText(proposed[pose][2]) + " " + toText(proposed[pose.subspan(1)][0]) + " " +
               std::string{proposed[names[1]].get()} + (proposed[on] ? " on" : " off");
    };
    cluster.start();
    EXPECT_EQ(seen, "0 0  off");

    const CallResult result = cluster.call("/settled", "set",
                                           {{"pose", std::vector{1.0, 2.0, 3.0}},
                                            {"names", std::vector<std::string>{"a", "b"}},
                                            {"on", true}});

    EXPECT_EQ(result.outcome, Outcome::Done) << result.text();
    EXPECT_EQ(seen, "3 2 b on");
}

TEST_F(Settings, AreNamedByTheirSetAlsoWhereTheirValueStays) {
    Probe& settled = cluster.probe("/settled", "SettledProbe");
    std::span<const double> pose;
    Data<const bool> on;
    settled.onPopulate = [&](Probe& self) {
        pose = self.array<const double>("pose");
        on = self.data<const bool>("on");
    };
    std::string seen;
    settled.onProposed = [&](Probe&, ProposedSettings& proposed) {
        seen = std::string{proposed.names(pose) ? "pose " : ""} + (proposed.names(on) ? "on" : "");
    };
    cluster.start();
    EXPECT_EQ(seen, "") << "these are the values to begin with";

    cluster.call("/settled", "set", {{"pose", std::vector{0.0, 0.0, 0.0}}});
    EXPECT_EQ(seen, "pose ");
    cluster.call("/settled", "set", {{"on", false}});
    EXPECT_EQ(seen, "on");
}

TEST_F(Settings, ThatNobodyJudgesAreAppliedAsTheyCome) {
    Probe& plain = cluster.probe("/plain");
    cluster.start();

    EXPECT_EQ(cluster.call("/plain", "set", {{"gain", 7.0}}).outcome, Outcome::Done);

    EXPECT_EQ(cluster.number(plain.path(), "gain"), 7);
}

// A sensor, and a controller that needs it and writes /d, of which both items are settable.
class SettingsOfADemand : public testing::Test {
protected:
    void start() {
        Simplex& signal = cluster.tree.add("/s", "Signal");
        Simplex& demand = cluster.tree.add("/d", "DriveWord");
        cluster.tree.relate(sensor, "out", signal);
        cluster.tree.relate(writer, "guarded", signal);
        cluster.tree.relate(writer, "out", demand);
        sensor.onLoopEnd = [this](Probe& self, const Tick&) {
            if (lost) self.setQuality(Quality::Lost);
        };
        writer.onActive = [this](Probe& self, const Tick&) {
            if (faults) self.fault(3, "asked for");
        };
        cluster.start();
        cluster.step(5);
    }
    void startUp() {
        cluster.startup(sensor);
        cluster.startup(writer);
        cluster.step(5);
    }
    std::string setSpeed(double speed) {
        return cluster.call("/d", "set", {{"speed", speed}}).text();
    }

    ProbeCluster cluster;
    Probe& sensor = cluster.probe("/sensor");
    Probe& writer = cluster.probe("/a");
    bool lost = false, faults = false;
};

TEST_F(SettingsOfADemand, AreRefusedWhileItsWriterRestsAndItsSafeValueStands) {
    start();

    EXPECT_EQ(setSpeed(5),
              "Rejected (state): /d is a demand that is safe: its writer /a is in Standby; a set "
              "would not act");
    EXPECT_EQ(cluster.number("/d", "speed"), 0);
    startUp();
    faults = true;
    cluster.step(5);

    EXPECT_EQ(setSpeed(5),
              "Rejected (state): /d is a demand that is safe: its writer /a is in Fault; a set "
              "would not act");
}

TEST_F(SettingsOfADemand, AreRefusedWhileItsWriterLacksAnInput) {
    start();
    startUp();
    lost = true;
    cluster.step(5);
    ASSERT_EQ(cluster.state("/a"), State::Active);

    EXPECT_EQ(setSpeed(5),
              "Rejected (state): /d is a demand that is safe: its writer /a has lost an input; a "
              "set would not act");
    EXPECT_EQ(cluster.number("/d", "speed"), 0);
}

TEST_F(SettingsOfADemand, AreRefusedWhileItsWriterIsActive) {
    start();
    startUp();

    EXPECT_EQ(setSpeed(5),
              "Rejected (state): /d is a demand that /a writes, which is Active; a set would not "
              "act");
    EXPECT_EQ(cluster.number("/d", "speed"), 0);
}

TEST_F(SettingsOfADemand, GoOutAtRestWhereTheItemIsItsWritersThen) {
    start();

    EXPECT_EQ(cluster.call("/d", "set", {{"word", std::int64_t{3}}}).text(), "Done");
    cluster.step(5);
    EXPECT_EQ(cluster.integer("/d", "word"), 3);
}

TEST(SettingsOfASharedDemand, AreRefusedAsThatOfOneWriterIsTakenInEachCycle) {
    SafePlant plant{true};
    plant.start();
    plant.startUp();

    EXPECT_EQ(plant.cluster.call("/d", "set", {{"velocity", 1.5}}).text(),
              "Rejected (state): /d has several writers, and what one of them writes goes out; a "
              "set would not act");
}

}  // namespace

}  // namespace cortex::test
