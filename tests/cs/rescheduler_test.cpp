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
    }
    AgentRuntime& agent() { return cluster_.cluster->agent(); }
    Schedule schedule(std::uint32_t count) const {
        return makeSchedule(graph_, {.threads = count, .chunkSize = 10, .force = true});
    }
    Rescheduler::Maker maker() {
        return {[this](std::span<const double>) {
                    ++looks;
                    return schedule(threads);
                },
                [](Schedule schedule) {
                    return std::make_unique<Plan>(Plan{std::move(schedule), nullptr});
                }};
    }
    void await(const std::function<bool()>& condition) const {
        const auto limit = std::chrono::steady_clock::now() + 60s;
        while (!condition() && std::chrono::steady_clock::now() < limit) std::this_thread::yield();
    }

    std::atomic<std::uint32_t> threads{2};
    std::atomic<int> looks{0};

private:
    test::ProbeCluster cluster_;
    TaskGraph graph_;
};

TEST(Rescheduler, OffersAPlanOnceItIsBetter) {
    Looks offers;
    const Schedule shared = offers.schedule(2);
    Plan* plan = new Plan{shared, nullptr};
    Rescheduler rescheduler{offers.agent(), shared, offers.maker(), 1ms};
    offers.await([&] { return offers.looks >= 3; });
    EXPECT_FALSE(rescheduler.exchange(plan));

    offers.threads = 1;  // a wake costs more than a hundred empty tasks
    offers.await([&] { return rescheduler.exchange(plan); });

    EXPECT_EQ(plan->schedule.threads, 1U);
    EXPECT_EQ(plan->schedule.tasks, shared.tasks);
    delete plan;
}

}  // namespace
}  // namespace cortex::cs
