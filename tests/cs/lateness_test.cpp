// SPDX-License-Identifier: Apache-2.0
#include "support/probe.hpp"
#include "support/stepped_clock.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {

namespace {

constexpr std::int64_t lateBy = 630'000;  // ns, of a period of 1 ms

// A loop of 1 kHz whose ticks are as late as the test says.
struct LateLoop : ProbeCluster {
    explicit LateLoop(cs::ClusterOptions options = {})
        : ProbeCluster{std::move(options)}, clock{cluster->setTriggerSource<SteppedClock>()} {
        trigger = &clock.trigger;
    }
    void stepLate(std::int64_t cycles, std::int64_t lateness) {
        clock.lateness = lateness;
        step(cycles);
        clock.lateness = 0;
    }
    // Events of the loop itself that tell of lateness.
    std::vector<std::string> told() {
        std::vector<std::string> lines = events();
        std::erase_if(lines, [](const std::string& line) {
            return line.find("deadline") == std::string::npos;
        });
        return lines;
    }

    SteppedClock& clock;
};

TEST(Lateness, IsToldOnceForAnEpisodeAndOnceWhenItIsOver) {
    LateLoop loop;
    loop.probe("/a");
    loop.start();
    loop.step(10);
    loop.stepLate(3'000, lateBy);
    const std::string begin =
        "/test: began 0.63 ms after its deadline, more than the warnLateness of 50 % allows "
        "(0.5 ms)";
    EXPECT_EQ(loop.told(), std::vector{begin});

    loop.stepLate(1, 900'000);
    loop.step(999);
    EXPECT_EQ(loop.told(), std::vector{begin}) << "a second without a late cycle is not over yet";
    loop.step(2);
    const std::string end =
        "/test: no longer late: 3001 of 3001 cycles began more than 0.5 ms after their deadlines, "
        "the latest 0.9 ms";
    EXPECT_EQ(loop.told(), (std::vector{begin, end}));
    loop.stepLate(1, lateBy);
    EXPECT_EQ(loop.told(), (std::vector{begin, end, begin}));
}

TEST(Lateness, IsNoEventBelowItsLimitOrWithoutOne) {
    LateLoop below, without{{.warnLateness = 0}};
    for (LateLoop* loop : {&below, &without}) {
        loop->probe("/a");
        loop->start();
    }
    below.stepLate(100, 500'000);
    without.stepLate(100, 3'000'000);

    EXPECT_TRUE(below.told().empty());
    EXPECT_TRUE(without.told().empty());
}

TEST(Lateness, AboveHaltLatenessFaultsAllThatIsActiveBeforeItsHooksRunInThatCycle) {
    LateLoop loop{{.warnLateness = 0, .haltLateness = 60}};
    Probe& probe = loop.probe("/a");
    int runs = 0;
    probe.onActive = [&](Probe&, const Tick&) { ++runs; };
    loop.start();
    loop.startup(probe);
    loop.stepLate(3, 600'000);
    EXPECT_EQ(loop.state("/a"), State::Active) << "as late as it may be";
    const int before = runs;

    loop.stepLate(3, lateBy);

    EXPECT_EQ(loop.state("/a"), State::Fault);
    EXPECT_EQ(runs, before);
    EXPECT_EQ(loop.integer("/a", "faultCode"), -5);
    EXPECT_EQ(loop.cluster->ended(), cs::Ended::Halted);
    EXPECT_EQ(loop.told(),
              std::vector<std::string>{"/test: began 0.63 ms after its deadline, more than the "
                                       "haltLateness of 60 % allows (0.6 ms)"});
    EXPECT_TRUE(loop.hasEvent("/a: fault -5: a cycle began later than haltLateness allows"));
}

}  // namespace

}  // namespace cortex::test
