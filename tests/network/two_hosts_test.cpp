// SPDX-License-Identifier: Apache-2.0
// Two agents and a tool on two hosts, joined by a network that fails in every way.
#include "network/hand_and_robot.hpp"
#include "network/host.hpp"

#include <algorithm>
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

constexpr std::int64_t maxAge = 50;  // cycles, and ms

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
    explicit Plant(bool peers = false) {
        if constexpr (std::is_same_v<Hosts, TwoHosts>) {
            if (peers) hosts.dropMulticast();
        }
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
        std::cout << what << ": whole " << static_cast<int>(time) << " ms after the start\n";
    }

    // Nothing is sent any more: what is to be said of all that happened.
    void check(const char* what, double networkDelay = 0) {
        checkCommands(what, station->end());
        const auto presses = hand->end();
        robot->end();
        checkButton(what, presses, networkDelay);
    }
    void checkCommands(const char* what, const std::map<std::int64_t, Station::Sent>& sent) {
        std::map<Outcome, int> counts;
        for (const auto& [number, each] : sent) ++counts[each.outcome];
        std::set<std::int64_t> done;
        for (const Executed& each : robot->executed()) {
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
        const auto executed = static_cast<std::int64_t>(done.size());
        const auto end = Clock::now() + 10s;
        while (station->count() != executed && Clock::now() < end) std::this_thread::sleep_for(1ms);
        EXPECT_EQ(station->count(), executed);
        std::cout << what << ": " << sent.size() << " commands, " << counts[Outcome::Done]
                  << " Done, " << counts[Outcome::Expired] << " Expired, "
                  << counts[Outcome::Unknown] << " Unknown; executed " << done.size() << "\n";
    }
    void checkButton(const char* what, const std::vector<Press>& presses, double networkDelay) {
        std::map<std::int64_t, double> late;
        std::int64_t oldest = 0;
        for (const Seen& each : robot->seen()) {
            oldest = std::max(oldest, each.cycles);
            if (each.press < 1 || each.press > static_cast<std::int64_t>(presses.size())) continue;
            const auto released = presses[static_cast<std::size_t>(each.press - 1)].released;
            late[each.press] = std::max(late[each.press], milliseconds(each.at - released));
        }
        std::vector<double> latest;
        for (const auto& [press, time] : late) latest.push_back(std::max(time, 0.0));
        ASSERT_GT(latest.size(), 3U);
        // The cycle that reads last may itself take the place of some.
        EXPECT_LE(oldest, maxAge + 2) << "cycles";
        EXPECT_LE(*std::ranges::max_element(latest), 10 * maxAge + networkDelay) << "ms";
        std::cout << what << ": still seen as pressed, ms after the release: " << figures(latest)
                  << " presses; longest without news " << oldest << " ms\n";
    }

    Hosts hosts;
    std::optional<HandAgent> hand;
    std::optional<RobotProcess> robot;
    std::optional<Station> station;
    std::int64_t lastWritten = 0;
};

// Where namespaces cannot be had the tests say so, and have shown nothing.
bool notRun() {
    static const std::string why = whyNoHosts();
    if (!why.empty()) std::cout << "not run: " << why << "\n";
    return !why.empty();
}

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
    if (notRun()) return;
    Plant<TwoHosts> plant;
    ASSERT_NO_FATAL_FAILURE(plant.start("cuts"));

    const bool soak = std::getenv("CORTEX_SOAK") != nullptr;
    cutFor(plant, 200ms, soak ? 50 : 10);
    cutFor(plant, 3s, soak ? 10 : 2);
    if (soak) cutFor(plant, 30s, 3);

    plant.check("cuts");
}

TEST(TwoHosts, GoOnWithFivePercentLoss) {
    if (notRun()) return;
    Plant<TwoHosts> plant;
    plant.hosts.losePercent(5);
    ASSERT_NO_FATAL_FAILURE(plant.start("5 % loss"));
    std::this_thread::sleep_for(6s);
    plant.hosts.passAll();
    std::cout << "5 % loss, end: whole after " << plant.becomesWhole("end") << " ms\n";

    plant.check("5 % loss");
}

TEST(TwoHosts, WorkWithDelayAndReordering) {
    if (notRun()) return;
    Plant<DelayedHosts> plant;
    ASSERT_NO_FATAL_FAILURE(plant.start("delay"));
    std::this_thread::sleep_for(5s);

    plant.check("20 ms delay, reordered", 30);
    EXPECT_GT(plant.hosts.overtaken(), plant.hosts.frames() / 100);
    std::cout << plant.hosts.frames() << " frames, " << plant.hosts.overtaken() << " overtaken\n";
}

TEST(TwoHosts, FindEachOtherWithoutMulticast) {
    if (notRun()) return;
    Plant<TwoHosts> plant{true};
    ASSERT_NO_FATAL_FAILURE(plant.start("no multicast"));
    cutFor(plant, 200ms, 5);

    plant.check("no multicast");
}

}  // namespace
}  // namespace cortex::test
