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
    EXPECT_EQ(told("/a: level of /seen is a number again"), 0);

    write([this] { level = 1.0; });
    cluster.step(3);

    EXPECT_EQ(cluster.quality("/seen"), Quality::Good);
    EXPECT_EQ(told("/a: level of /seen is a number again"), 1);
}

TEST_F(WrittenValues, OutOfTheirRangeThatThenAreNoNumbersAreToldOfBoth) {
    for (const double value : {3.0, nan, nan, 3.0, 3.0, 1.0}) {
        write([this, value] { level = value; });
        cluster.step();
    }
    EXPECT_EQ(told("/a: level of /seen is 3 m, out of its range -2 .. 2"), 2);
    EXPECT_EQ(told("/a: level of /seen is not a number: its quality is bad"), 1);
    EXPECT_EQ(told("/a: level of /seen is a number again"), 1);
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

// /a shows two names of its own.
struct WrittenTexts : testing::Test {
    WrittenTexts() {
        probe.onPopulate = [this](Probe& self) { names = self.array<std::string_view>("names"); };
        cluster.start();
        cluster.startup(probe);
    }
    void write(std::string_view text) {
        probe.onActive = [this, text](Probe&, const Tick&) { names[1] = text; };
        cluster.step();
    }
    std::int64_t told(const std::string& part) {
        const std::vector<std::string> events = cluster.events();
        return std::ranges::count_if(
            events, [&](const std::string& each) { return each.find(part) != std::string::npos; });
    }

    ProbeCluster cluster;
    Probe& probe = cluster.probe("/a", "SettledProbe");
    TextArray<std::string_view> names;
};

TEST_F(WrittenTexts, ThatOthersCanReadAreNotTold) {
    for (const char* each : {"", "\x01\x7f", "\u00e9\U0001F600"}) write(each);

    EXPECT_EQ(told("names of /a"), 0);
}

TEST_F(WrittenTexts, WithTheOctet0AreToldOnceAndStand) {
    const std::string_view text{"a\0b", 3};
    write(text);
    write("good");
    write(text);

    EXPECT_EQ(told("/a: names of /a has the octet 0: other agents and tools get what is in front "
                   "of it"),
              1);
    EXPECT_EQ(names[1].get(), text);
    EXPECT_EQ(cluster.quality("/a"), Quality::Good);
    EXPECT_EQ(cluster.integer("/test", "limitCount"), 0);
}

TEST_F(WrittenTexts, ThatAreNoUtf8AreToldOnce) {
    write("\xff");
    write("\xfe");

    EXPECT_EQ(told("names of /a is not UTF-8"), 1);
}

// /a observes /switches, whose labels are its range but for `open`.
struct WrittenLabels : testing::Test {
    WrittenLabels() {
        cluster.tree.relate(probe, "out", cluster.tree.add("/switches", "Switches"));
        probe.onPopulate = [this](Probe& self) {
            const OutputSimplex out = self.output("out");
            mode = out.data<std::int64_t>("mode");
            step = out.data<std::int64_t>("step");
            open = out.data<std::int64_t>("open");
        };
        cluster.start();
        cluster.startup(probe);
    }
    void write(std::int64_t newMode, std::int64_t newStep, std::int64_t newOpen = 0) {
        probe.onActive = [=, this](Probe&, const Tick&) {
            mode = newMode;
            step = newStep;
            open = newOpen;
        };
        cluster.step();
    }
    std::int64_t told(const std::string& text) {
        const std::vector<std::string> events = cluster.events();
        return std::ranges::count(events, text);
    }

    ProbeCluster cluster;
    Probe& probe = cluster.probe("/a");
    Data<std::int64_t> mode, step, open;
};

TEST_F(WrittenLabels, ThatExistAreRightWhetherOrNotTheyLeaveGaps) {
    for (const std::int64_t each : {0, 5, 900}) write(1, each, 77);
    cluster.step();

    EXPECT_EQ(cluster.integer("/test", "limitCount"), 0);
    EXPECT_FALSE(cluster.hasEvent("labels"));
}

TEST_F(WrittenLabels, ThatDoNotExistAreOutOfRangeToldOnceAndCountedButStand) {
    write(7, 1);
    cluster.step(2);
    write(-1, 899);
    cluster.step();

    EXPECT_EQ(cluster.integer("/switches", "mode"), -1);
    EXPECT_EQ(cluster.quality("/switches"), Quality::Good);
    EXPECT_EQ(cluster.integer("/test", "limitCount"), 5);
    EXPECT_EQ(told("/a: mode of /switches is 7, none of its labels 0:Off 1:On"), 1);
    EXPECT_EQ(told("/a: step of /switches is 1, none of its labels 0:Rest 5:Go 900:Done"), 1);
    write(0, 0);
    write(0, 901);
    EXPECT_EQ(told("/a: step of /switches is 901, none of its labels 0:Rest 5:Go 900:Done"), 1);
}

// /a demands modes of /order.
struct DemandedLabels : testing::Test {
    DemandedLabels() {
        cluster.tree.relate(probe, "out", cluster.tree.add("/order", "SwitchOrder"));
        probe.onPopulate = [this](Probe& self) {
            mode = self.output("out").data<std::int64_t>("mode");
            step = self.output("out").array<std::int64_t>("step");
        };
        cluster.start();
        cluster.startup(probe);
    }
    void write(std::int64_t newMode, std::int64_t newStep = 0) {
        probe.onActive = [=, this](Probe&, const Tick&) {
            mode = newMode;
            step[1] = newStep;
        };
        cluster.step();
    }

    ProbeCluster cluster;
    Probe& probe = cluster.probe("/a");
    Data<std::int64_t> mode;
    std::span<std::int64_t> step;
};

TEST_F(DemandedLabels, ThatDoNotExistLeaveTheValueThatWentOutLast) {
    write(4);
    EXPECT_EQ(cluster.integer("/order", "mode"), 4);
    for (const std::int64_t wrong : {2, 5, -1}) {
        write(wrong);
        EXPECT_EQ(cluster.integer("/order", "mode"), 4) << "nothing lies between labels";
    }
    EXPECT_EQ(cluster.state("/a"), State::Active);
    EXPECT_TRUE(cluster.hasEvent("/a: mode of /order was 2, none of its labels; 4 stays"));
    EXPECT_FALSE(cluster.hasEvent("was 5")) << "one episode";
    write(1);

    EXPECT_EQ(cluster.integer("/order", "mode"), 1);
}

TEST_F(DemandedLabels, ThatDoNotExistFaultTheWriterWhereTheTypeSaysSo) {
    write(1, 5);
    ASSERT_EQ(cluster.state("/a"), State::Active);
    write(1, 3);

    EXPECT_EQ(cluster.state("/a"), State::Fault);
    EXPECT_EQ(cluster.integer("/a", "faultCode"), -4);
    EXPECT_TRUE(cluster.hasEvent("step of /order was out of range"));
}

}  // namespace

}  // namespace cortex::test
