// SPDX-License-Identifier: Apache-2.0
#include "rescheduler.hpp"

#include "cs/graphs.hpp"
#include "support/probe.hpp"

#include <atomic>
#include <chrono>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::cs {
namespace {

using namespace std::chrono_literals;

TEST(Rescheduler, ExpectsEachThreadToRunItsShareAfterWhatItWaitsFor) {
    const TaskGraph graph =
        graphOf({"/a", "/b", "/c", "/d", "/e"}, {{0, 4}, {1, 4}, {2, 4}, {3, 4}});
    const std::vector<double> costs = {100, 100, 100, 100, 50};
    const Schedule one = makeSchedule(graph, {.threads = 1});
    const Schedule two = makeSchedule(graph, {.threads = 2, .costMicroseconds = costs});
    ASSERT_EQ(two.threads, 2U);

    EXPECT_DOUBLE_EQ(expectedMicroseconds(one, costs), 450);
    EXPECT_NEAR(expectedMicroseconds(two, costs), 250, 30);  // and the wake of a thread
}

TEST(Rescheduler, ExpectsThreadsToWaitForWhatCrossesBetweenTheirCpus) {
    const TaskGraph graph = graphOf({"/a", "/b", "/c", "/d"}, {{0, 3}, {1, 2}});
    const std::vector<double> costs = {100, 100, 100, 100};
    const Schedule one = makeSchedule(graph, {.threads = 1});
    const Schedule two = makeSchedule(graph, {.threads = 2, .chunkSize = 1, .force = true});

    EXPECT_DOUBLE_EQ(expectedMicroseconds(one, costs, 0.4), expectedMicroseconds(one, costs));
    EXPECT_NEAR(expectedMicroseconds(two, costs, 0.4) - expectedMicroseconds(two, costs),
                sharingMicroseconds(two, 0.4) - sharingMicroseconds(two, 0), 1e-9);
    EXPECT_GT(sharingMicroseconds(two, 0.4), sharingMicroseconds(two, 0));
}

TEST(Rescheduler, TakesWhatCrossesOffTheTimesOfTasksButNoMoreThanHalf) {
    const TaskGraph graph = graphOf({"/a", "/b", "/c", "/d"}, {{0, 3}, {1, 2}});
    const std::vector<double> costs = {1, 1, 1, 0};
    Schedule schedule = makeSchedule(graph, {.threads = 2, .chunkSize = 1, .force = true});
    schedule.crossings = 2;
    const double line = 0.6 / crossingMicroseconds(schedule, 1);

    const std::vector<double> without = withoutCrossings(schedule, costs, line);
    EXPECT_NEAR(without[0], 0.8, 1e-9);
    EXPECT_EQ(without[3], 0);  // not timed yet
    EXPECT_EQ(withoutCrossings(schedule, costs, 100 * line),
              (std::vector<double>{0.5, 0.5, 0.5, 0}));
    schedule.crossings = 0;
    EXPECT_EQ(withoutCrossings(schedule, costs, line), costs);
}

// Tasks in a loop that uses two threads, whose CPUs are then found to be far from each other.
TEST(Rescheduler, OffersOneThreadOnceTheCpusAreTooFarFromEachOther) {
    test::ProbeCluster cluster;
    for (int i = 0; i < 100; ++i) cluster.probe("/p" + std::to_string(100 + i));
    cluster.start();
    cluster.step(10);
    AgentRuntime& agent = cluster.cluster->agent();
    TaskGraph graph;
    for (const SimplexInfo& info : agent.structure().simplexes) {
        graph.nodes.push_back({info.path, info.path.starts_with("/p"), 1, 0});
    }
    const Schedule shared = makeSchedule(graph, {.threads = 2, .force = true});
    ASSERT_EQ(shared.threads, 2U);
    std::atomic<double> line{0};
    Plan* plan = new Plan{shared, {}, nullptr};
    Rescheduler rescheduler{
        agent,
        shared,
        {[&] { return line.load(); },
         [&](std::span<const double> costs, double measured) {
             ScheduleOptions options{.threads = 2, .costMicroseconds = costs};
             options.lineMicroseconds = measured;
             options.force = measured == 0;
             return makeSchedule(graph, options);
         },
         [](Schedule schedule) {
             return std::make_unique<Plan>(Plan{std::move(schedule), {}, nullptr});
         }},
        1ms};
    EXPECT_FALSE(rescheduler.exchange(plan));
    line = 1000;
    const auto limit = std::chrono::steady_clock::now() + 60s;
    while (!rescheduler.exchange(plan) && std::chrono::steady_clock::now() < limit) {
        std::this_thread::yield();
    }
    EXPECT_EQ(plan->schedule.threads, 1U);
    EXPECT_EQ(plan->schedule.tasks, shared.tasks);
    delete plan;
}

}  // namespace
}  // namespace cortex::cs
