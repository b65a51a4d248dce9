// SPDX-License-Identifier: Apache-2.0
#include "support/probe.hpp"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

namespace cortex::test {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// /a observes /seen, whose level is from -2 to 2 m, and shows a result of its own.
class WrittenValues : public testing::Test {
protected:
    WrittenValues() {
        cluster.tree.relate(probe, "out", seen);
        cluster.tree.relate(reader, "in", seen);
        probe.onPopulate = [this](Probe& self) {
            level = self.output("out").data<double>("level");
            forces = self.output("out").array<double>("forces");
            parts = self.output("out").data<std::int64_t>("parts");
            result = self.data<double>("result");
            executed = self.data<std::int64_t>("executed");
        };
        reader.onActive = [this](Probe& self, const Tick&) { lost = self.inputLost(); };
        cluster.start();
        cluster.startup(probe);
        cluster.startup(reader);
        cluster.step();
        before = cluster.integer("/test", "limitCount");
    }
    // What the probe writes in each cycle from now on.
    template <class Function>
    void write(Function function) {
        probe.onActive = [function](Probe&, const Tick&) { function(); };
    }
    std::int64_t counted() { return cluster.integer("/test", "limitCount") - before; }
    std::int64_t told(const std::string& text) {
        const std::vector<std::string> events = cluster.events();
        return std::ranges::count(events, text);
    }

    ProbeCluster cluster;
    Probe& probe = cluster.probe("/a");
    Probe& reader = cluster.probe("/b");
    Simplex& seen = cluster.tree.add("/seen", "Seen");
    Data<double> level, result;
    std::span<double> forces;
    Data<std::int64_t> parts, executed;
    bool lost = false;
    std::int64_t before = 0;
};

TEST_F(WrittenValues, ThatAreRightAreGoodAndNotCounted) {
    write([this] {
        level = -2.0;
        forces[2] = std::numeric_limits<double>::max();
        parts = 8;
        result = 1e300;
    });

    cluster.step(3);

    EXPECT_EQ(cluster.quality("/seen"), Quality::Good);
    EXPECT_EQ(cluster.quality("/a"), Quality::Good);
    EXPECT_EQ(counted(), 0);
}

TEST_F(WrittenValues, OfAnObservationThatAreNoNumbersMakeItBadInTheSameCycle) {
    write([this] { level = nan; });

    cluster.step();

    EXPECT_EQ(cluster.quality("/seen"), Quality::Bad);
    EXPECT_EQ(cluster.quality("/a"), Quality::Good);
    EXPECT_TRUE(lost);
    EXPECT_EQ(told("/a: level of /seen is not a number: its quality is bad"), 1);
}

TEST_F(WrittenValues, OfAnArrayAreLookedAtOneByOne) {
    write([this] { forces[2] = infinity; });

    cluster.step();

    EXPECT_EQ(cluster.quality("/seen"), Quality::Bad);
    EXPECT_EQ(told("/a: forces of /seen is not a number: its quality is bad"), 1);
}

TEST_F(WrittenValues, OutOfTheRangeAreToldOnceAndCountedInEachCycleButStand) {
    write([this] {
        level = 2.5;
        parts = 9;
    });

    cluster.step(4);

    EXPECT_EQ(cluster.number("/seen", "level"), 2.5);
    EXPECT_EQ(cluster.quality("/seen"), Quality::Good);
    EXPECT_FALSE(lost);
    EXPECT_EQ(counted(), 4);
    EXPECT_EQ(told("/a: level of /seen is 2.5 m, out of its range -2 .. 2"), 1);
    EXPECT_EQ(told("/a: parts of /seen is 9, out of its range  .. 8"), 1);
}

TEST_F(WrittenValues, AreToldAnewAfterTheyWereRight) {
    for (const double value : {3.0, 3.0, 1.0, 3.0}) {
        write([this, value] { level = value; });
        cluster.step();
    }

    EXPECT_EQ(told("/a: level of /seen is 3 m, out of its range -2 .. 2"), 2);
    EXPECT_EQ(counted(), 3);
}

TEST_F(WrittenValues, AreBadAsLongAsTheyAreNoNumbersAndGoodAfterwards) {
    write([this] { level = nan; });
    cluster.step(3);
    EXPECT_EQ(cluster.quality("/seen"), Quality::Bad);
    EXPECT_EQ(counted(), 0) << "that is no limit";

    write([this] { level = 1.0; });
    cluster.step();

    EXPECT_EQ(cluster.quality("/seen"), Quality::Good);
}

TEST_F(WrittenValues, OfItsOwnThatAreNoNumbersMakeASimplexBad) {
    write([this] { result = nan; });

    cluster.step();

    EXPECT_EQ(cluster.quality("/a"), Quality::Bad);
    EXPECT_EQ(cluster.quality("/seen"), Quality::Good);
    EXPECT_EQ(cluster.state("/a"), State::Active);
    EXPECT_EQ(told("/a: result of /a is not a number: its quality is bad"), 1);
}

TEST_F(WrittenValues, AreLookedAtInEveryState) {
    cluster.call("/a", "shutdown");
    cluster.step(2);
    probe.onStandby = [this](Probe&, const Tick&) { level = infinity; };

    cluster.step();

    EXPECT_EQ(cluster.state("/a"), State::Standby);
    EXPECT_EQ(cluster.quality("/seen"), Quality::Bad);
}

}  // namespace

}  // namespace cortex::test
