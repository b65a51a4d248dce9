// SPDX-License-Identifier: Apache-2.0
#include "loop/rescheduler.hpp"

#include "cs/graphs.hpp"
#include "support/probe.hpp"

#include <atomic>
#include <chrono>
#include <functional>
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

// Of four tasks the first two run on one thread and the last two on the other.
TEST(Rescheduler, ExpectsThreadsToWaitForWhatCrossesBetweenTheirCpus) {
    const TaskGraph graph =
        graphOf({"/a", "/b", "/c", "/d", "/e", "/f", "/g", "/h"}, {{0, 4}, {0, 7}, {3, 6}, {3, 5}});
    const std::vector<double> costs(8, 100);
    const Schedule one = makeSchedule(graph, {.threads = 1});
    const Schedule two = makeSchedule(graph, {.threads = 2, .chunkSize = 1, .force = true});
    Schedule without = two;
    without.crossings = 0;
    ASSERT_EQ(two.crossings, 2);

    EXPECT_DOUBLE_EQ(expectedMicroseconds(one, costs, 100), expectedMicroseconds(one, costs, 0));
    EXPECT_GT(expectedMicroseconds(without, costs, 100), expectedMicroseconds(without, costs, 0));
    EXPECT_NEAR(expectedMicroseconds(two, costs, 100) - expectedMicroseconds(without, costs, 100),
                crossingMicroseconds(two, 100) / 2, 1e-9);
    EXPECT_GT(crossingMicroseconds(two, 100), 0);
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

// A hundred tasks that two threads share, and what a look at them offers.
class Looks {
public:
    Looks() {
        for (int i = 0; i < 100; ++i) cluster_.probe("/p" + std::to_string(100 + i));
        cluster_.start();
        cluster_.step(10);
        for (const SimplexInfo& info : agent().structure().simplexes) {
            graph_.nodes.push_back({info.path, info.path.starts_with("/p"), 1, 0});
        }
        costs_.assign(graph_.nodes.size(), 5);
    }
    AgentRuntime& agent() { return cluster_.cluster->agent(); }
    Schedule scheduleFor(double lineMicroseconds, bool force = false) const {
        ScheduleOptions options{.threads = 2, .chunkSize = 10, .costMicroseconds = costs_};
        options.lineMicroseconds = lineMicroseconds;
        options.force = force;
        return makeSchedule(graph_, options);
    }
    Rescheduler::Maker maker() {
        return {[this] {
                    ++count;
                    return line.load();
                },
                [this](std::span<const double>, double measured) { return scheduleFor(measured); },
                [](Schedule schedule) {
                    return std::make_unique<Plan>(Plan{std::move(schedule), {}, nullptr});
                }};
    }
    void await(const std::function<bool()>& condition) const {
        const auto limit = std::chrono::steady_clock::now() + 60s;
        while (!condition() && std::chrono::steady_clock::now() < limit) std::this_thread::yield();
    }

    std::atomic<double> line{0};
    std::atomic<int> count{0};

private:
    test::ProbeCluster cluster_;
    TaskGraph graph_;
    std::vector<double> costs_;
};

TEST(Rescheduler, OffersOneThreadOnceTheCpusAreTooFarFromEachOther) {
    Looks looks;
    looks.line = 0.06;
    const Schedule shared = looks.scheduleFor(0.06);
    ASSERT_EQ(shared.threads, 2U);
    Plan* plan = new Plan{shared, {}, nullptr};
    Rescheduler rescheduler{looks.agent(), shared, looks.maker(), 1ms};
    looks.await([&] { return looks.count >= 3; });
    EXPECT_FALSE(rescheduler.exchange(plan));

    looks.line = 1000;
    looks.await([&] { return rescheduler.exchange(plan); });

    EXPECT_EQ(plan->schedule.threads, 1U);
    EXPECT_EQ(plan->schedule.tasks, shared.tasks);
    delete plan;
}

TEST(Rescheduler, KeepsTheDistanceThatWasKnownAtTheStartWhileNoOtherIs) {
    Looks looks;
    const Schedule shared = looks.scheduleFor(1000, true);
    ASSERT_EQ(shared.threads, 2U);
    Plan* plan = new Plan{shared, {}, nullptr};
    Rescheduler rescheduler{looks.agent(), shared, looks.maker(), 1ms};

    looks.await([&] { return rescheduler.exchange(plan); });

    EXPECT_EQ(plan->schedule.threads, 1U);
    delete plan;
}

}  // namespace
}  // namespace cortex::cs
