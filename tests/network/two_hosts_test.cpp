// SPDX-License-Identifier: Apache-2.0
// Two agents and a tool on two hosts, joined by a network that fails in every way.
#include "network/hand_and_robot.hpp"
#include "network/host.hpp"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <optional>
#include <set>
#include <type_traits>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace std::chrono_literals;

constexpr double maxAge = 50;           // ms
constexpr double longestStart = 1'500;  // ms; on a free machine without sanitizer a third of that
enum class Network : std::uint8_t { Usual, WithoutMulticast, WithoutNames };

double milliseconds(Clock::duration duration) {
    return std::chrono::duration<double, std::milli>(duration).count();
}

// "median 1, p95 2, worst 3 of 10"
std::string figures(std::vector<double> values) {
    if (values.empty()) return "none";
    std::ranges::sort(values);
    const auto at = [&](double share) {
        return std::to_string(static_cast<int>(
            values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))] +
            0.5));
    };
    return "median " + at(0.5) + ", p95 " + at(0.95) + ", worst " + at(1) + " of " +
           std::to_string(values.size());
}

// The hand and the station on the first host, the robot on the second.
template <class Hosts>
struct Plant {
    explicit Plant(Network kind = Network::Usual) {
        const bool peers = kind == Network::WithoutMulticast;
        if constexpr (std::is_same_v<Hosts, TwoHosts>) {
            if (peers) hosts.dropMulticast();
            if (kind == Network::WithoutNames) hosts.silenceNames();
        }
        began = Clock::now();
        hosts.first.within([&] { hand.emplace(network(peers ? "10.77.0.2" : "")); });
        hosts.second.within([&] { robot.emplace(peers ? "10.77.0.1" : ""); });
        hosts.first.within([&] { station.emplace(network(peers ? "10.77.0.2" : "")); });
    }

    // Until both sides have newer data of the other than now; ms, negative: not within 15 s.
    double becomesWhole(const char* what) {
        const auto begin = Clock::now();
        const std::int64_t cycle = station->cycleOfRobot(), written = lastWritten;
        std::optional<double> link, mirror;
        while (!link || !mirror) {
            const double now = milliseconds(Clock::now() - begin);
            if (now > 15'000) {
                ADD_FAILURE() << what << ": link " << link.value_or(-1) << " ms, tool "
                              << mirror.value_or(-1) << " ms";
                return -1;
            }
            if (!link && robot->newest() > written) link = now;
            if (!mirror && station->sees(cycle)) mirror = now;
            std::this_thread::sleep_for(1ms);
        }
        lastWritten = robot->newest();
        return std::max(*link, *mirror);
    }

    void start(const char* what) {
        const double time = becomesWhole(what);
        ASSERT_GE(time, 0);
        station->begin();
        hand->beginOrders();
        std::cout << what << ": whole " << static_cast<int>(time) << " ms after the start\n";
    }

    // Nothing is sent any more: what is to be said of all that happened.
    void check(const char* what, double networkDelay = 2) {
        const auto limit = Clock::now() + 20s;
        while (station->done() == 0 && Clock::now() < limit) std::this_thread::sleep_for(1ms);
        hand->endOrders();
        checkCommands(what, station->end());
        const auto end = Clock::now() + 60s;
        while (robot->presses() < 5 && Clock::now() < end) std::this_thread::sleep_for(10ms);
        hand->end();
        robot->end();
        checkOrders(what);
        checkButton(what, networkDelay);
    }
    void checkCommands(const char* what, const std::map<std::int64_t, Station::Sent>& sent) {
        std::map<Outcome, int> counts;
        for (const auto& [number, each] : sent) ++counts[each.outcome];
        std::set<std::int64_t> done;
        const auto isOrder = [](const Executed& each) {
            return each.number > HandAgent::firstOrder;
        };
        for (const Executed& each : robot->executed()) {
            if (isOrder(each)) continue;
            EXPECT_TRUE(done.insert(each.number).second) << each.number << " was executed twice";
            const auto found = sent.find(each.number);
            ASSERT_NE(found, sent.end());
            EXPECT_LE(each.cycle, found->second.latest) << each.number << " after its time";
            EXPECT_TRUE(found->second.outcome == Outcome::Done ||
                        found->second.outcome == Outcome::Unknown)
                << each.number << " was executed, and is " << name(found->second.outcome);
        }
        for (const auto& [number, each] : sent) {
            EXPECT_TRUE(each.outcome == Outcome::Done || each.outcome == Outcome::Expired ||
                        each.outcome == Outcome::Unknown)
                << number << " is " << name(each.outcome);
            if (each.outcome == Outcome::Done) {
                EXPECT_TRUE(done.contains(number)) << number;
            }
        }
        EXPECT_GT(counts[Outcome::Done], 0);
        const auto executed = std::ssize(done) + std::ranges::count_if(robot->executed(), isOrder);
        const auto end = Clock::now() + 10s;
        while (station->count() != executed && Clock::now() < end) std::this_thread::sleep_for(1ms);
        EXPECT_EQ(station->count(), executed);
        std::cout << what << ": " << sent.size() << " commands, " << counts[Outcome::Done]
                  << " Done, " << counts[Outcome::Expired] << " Expired, "
                  << counts[Outcome::Unknown] << " Unknown; executed " << done.size() << "\n";
    }
    // Along a relationship: each at most once, in order, and what is said of it is true.
    void checkOrders(const char* what) {
        std::map<std::int64_t, Outcome> ordered;
        std::map<Outcome, int> counts;
        for (const Ordered& each : hand->ordered()) {
            ordered[each.number] = each.outcome;
            ++counts[each.outcome];
        }
        std::int64_t last = 0;
        std::set<std::int64_t> executed;
        for (const Executed& each : robot->executed()) {
            if (each.number <= HandAgent::firstOrder) continue;
            EXPECT_GT(each.number, last) << "twice, or overtaken";
            last = each.number;
            executed.insert(last);
            ASSERT_TRUE(ordered.contains(last)) << last;
            EXPECT_TRUE(ordered[last] == Outcome::Done || ordered[last] == Outcome::Unknown)
                << last << " was executed, and is " << name(ordered[last]);
        }
        for (const auto& [number, outcome] : ordered) {
            EXPECT_TRUE(outcome != Outcome::Done || executed.contains(number)) << number;
        }
        EXPECT_GT(counts[Outcome::Done], 0);
        std::cout << what << ": " << ordered.size() << " commands of the hand, "
                  << counts[Outcome::Done] << " Done, " << counts[Outcome::Expired] << " Expired, "
                  << counts[Outcome::Unknown] << " Unknown; executed " << executed.size() << "\n";
    }
    // How old what is seen as pressed was, from the hand's cycle that wrote it to the wake-up of
    // the robot's cycle that read it: no load of this machine excuses more than maxAge.
    void checkButton(const char* what, double networkDelay) {
        const auto presses = hand->presses();
        const auto written = hand->written();
        std::map<std::int64_t, double> late;  // by press
        std::vector<double> underway, ages;
        for (const Seen& each : robot->seen()) {
            const auto of = std::ranges::lower_bound(written, each.written, {}, &Written::cycle);
            ASSERT_NE(of, written.end());
            ages.push_back(milliseconds(robot->timeOf(each.at) - of->at));
            if (each.at == each.came) underway.push_back(ages.back());
            if (each.press > static_cast<std::int64_t>(presses.size())) continue;  // not released
            const Press& press = presses[static_cast<std::size_t>(each.press - 1)];
            EXPECT_LT(each.written, press.released);
            double& latest = late[each.press];
            latest = std::max(latest, milliseconds(robot->timeOf(each.at) - press.at));
        }
        std::vector<double> latest;
        for (const auto& [press, time] : late) latest.push_back(time);
        ASSERT_FALSE(latest.empty());
        EXPECT_LE(*std::ranges::max_element(ages), maxAge + networkDelay);
        EXPECT_LE(*std::ranges::max_element(latest), maxAge + networkDelay);
        std::cout << what << ": ms still seen as pressed after the release: " << figures(latest)
                  << " presses; on their way: " << figures(underway)
                  << "; when read: " << figures(ages) << "\n";
    }

    Hosts hosts;
    Clock::time_point began;  // when the first agent was started
    std::optional<HandAgent> hand;
    std::optional<RobotProcess> robot;
    std::optional<Station> station;
    std::int64_t lastWritten = 0;
};

template <class Hosts>
void cutFor(Plant<Hosts>& plant, std::chrono::milliseconds time, int rounds) {
    std::vector<double> recoveries;
    for (int i = 0; i < rounds; ++i) {
        plant.hosts.cut();
        std::this_thread::sleep_for(time);
        plant.hosts.join();
        recoveries.push_back(plant.becomesWhole("after a cut"));
        std::this_thread::sleep_for(300ms);
    }
    std::cout << "cut for " << time.count()
              << " ms: whole again, ms after the link's return: " << figures(recoveries) << "\n";
}

TEST(TwoHosts, GoOnAfterTheirLinkWasCut) {
    if (const std::string why = whyNoHosts(); !why.empty()) GTEST_SKIP() << why;
    Plant<TwoHosts> plant;
    ASSERT_NO_FATAL_FAILURE(plant.start("cuts"));

    const bool soak = std::getenv("CORTEX_SOAK") != nullptr;
    cutFor(plant, 200ms, soak ? 50 : 10);
    cutFor(plant, 3s, soak ? 10 : 2);
    if (soak) cutFor(plant, 30s, 3);

    plant.check("cuts");
}

TEST(TwoHosts, GoOnWithFivePercentLoss) {
    if (const std::string why = whyNoHosts(); !why.empty()) GTEST_SKIP() << why;
    Plant<TwoHosts> plant;
    plant.hosts.losePercent(5);
    ASSERT_NO_FATAL_FAILURE(plant.start("5 % loss"));
    std::this_thread::sleep_for(6s);
    plant.hosts.passAll();
    std::cout << "5 % loss, end: whole after " << plant.becomesWhole("end") << " ms\n";

    plant.check("5 % loss");
}

TEST(TwoHosts, WorkWithDelayAndReordering) {
    if (const std::string why = whyNoHosts(); !why.empty()) GTEST_SKIP() << why;
    if (const std::string why = whyNoRelay(); !why.empty()) GTEST_SKIP() << why;
    Plant<DelayedHosts> plant;
    ASSERT_NO_FATAL_FAILURE(plant.start("delay"));
    std::this_thread::sleep_for(5s);

    plant.check("20 ms delay, reordered", 30);
    EXPECT_GT(plant.hosts.overtaken(), plant.hosts.frames() / 100);
    std::cout << plant.hosts.frames() << " frames, " << plant.hosts.overtaken() << " overtaken\n";
}

TEST(TwoHosts, FindEachOtherWithoutMulticast) {
    if (const std::string why = whyNoHosts(); !why.empty()) GTEST_SKIP() << why;
    Plant<TwoHosts> plant{Network::WithoutMulticast};
    ASSERT_NO_FATAL_FAILURE(plant.start("no multicast"));
    cutFor(plant, 200ms, 5);

    plant.check("no multicast");
}

// A resolver gives up after 5 s and more. Between hosts with names that nobody knows, none is
// asked.
TEST(TwoHosts, MeetAtOnceWhereNoNameServiceAnswers) {
    if (const std::string why = whyNoHosts(); !why.empty()) GTEST_SKIP() << why;
    Plant<TwoHosts> plant{Network::WithoutNames};
    ASSERT_NO_FATAL_FAILURE(plant.start("no names"));
    const double time = milliseconds(Clock::now() - plant.began);
    std::cout << "no names: whole " << static_cast<int>(time) << " ms after the first start\n";
    EXPECT_LT(time, longestStart);
    EXPECT_EQ(plant.hosts.askedForNames(), 0);

    plant.check("no names");
}

// The cards stay up, so it is our own time that is measured: after a card came up again, Linux may
// take a second before it sends.
TEST(TwoHosts, AreWholeSoonAfterTheNetworkWorksAgain) {
    if (const std::string why = whyNoHosts(); !why.empty()) GTEST_SKIP() << why;
    Plant<TwoHosts> plant;
    ASSERT_NO_FATAL_FAILURE(plant.start("losses"));
    for (const std::chrono::milliseconds time :
         {200ms, 200ms, 200ms, 3'000ms, 12'000ms, 30'000ms}) {
        plant.hosts.loseAll();
        std::this_thread::sleep_for(time);
        plant.hosts.passAll();
        const double recovery = plant.becomesWhole("after a loss");
        std::cout << "nothing passed for " << time.count() << " ms: whole "
                  << static_cast<int>(recovery) << " ms later\n";
        EXPECT_LT(recovery, longestStart);
    }
    plant.check("losses");
}

TEST(TwoHosts, AreWholeSoonAfterOneOfThemStoodStill) {
    if (const std::string why = whyNoHosts(); !why.empty()) GTEST_SKIP() << why;
    Plant<TwoHosts> plant;
    ASSERT_NO_FATAL_FAILURE(plant.start("standing still"));
    for (const std::chrono::seconds time : {1s, 5s, 12s, 30s}) {
        kill(plant.robot->pid(), SIGSTOP);
        std::this_thread::sleep_for(time);
        kill(plant.robot->pid(), SIGCONT);
        const double recovery = plant.becomesWhole("after standing still");
        std::cout << "stood still for " << time.count() << " s: whole "
                  << static_cast<int>(recovery) << " ms later\n";
        EXPECT_LT(recovery, longestStart);
    }
    plant.check("standing still");
}

}  // namespace
}  // namespace cortex::test
