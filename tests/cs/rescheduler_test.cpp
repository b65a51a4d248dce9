// SPDX-License-Identifier: Apache-2.0
#include "loop/rescheduler.hpp"

#include "cortex/core/agent.hpp"
#include "cortex/core/framework_item.hpp"

#include "cs/graphs.hpp"
#include "support/agent_rig.hpp"
#include "support/waiting.hpp"

#include <atomic>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::cs {
namespace {

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

// Two hundred tasks on one thread, each of which states that it costs a second, and what a look
// at them offers: two threads are better.
class ReschedulerTest : public testing::Test {
protected:
    ReschedulerTest() {
        for (int i = 0; i < 200; ++i) rig_.hand("/p" + std::to_string(1000 + i));
        rig_.start();
        for (std::uint32_t i = 0; i < agent().structure().simplexes.size(); ++i) {
            if (!agent().structure().simplexes[i].path.starts_with("/p")) continue;
            frameworkItem<double>(agent(), i, "taskTime") = 1'000'000;
        }
        rig_.step();
        for (const SimplexInfo& info : agent().structure().simplexes) {
            graph_.nodes.push_back({info.path, info.path.starts_with("/p"), 1, 0});
        }
        plan = std::make_unique<Plan>(Plan{schedule(1), nullptr});
        rescheduler = std::make_unique<Rescheduler>(agent(), plan->schedule, maker());
    }
    ~ReschedulerTest() override { rescheduler.reset(); }  // it may still look at the agent
    AgentRuntime& agent() { return *rig_.agent; }
    Schedule schedule(std::uint32_t count) const {
        return makeSchedule(graph_, {.threads = count, .chunkSize = 10, .force = true});
    }
    // Looks are done; what they offer is taken. False: nothing was.
    bool exchanged() {
        bool exchanged = false;
        EXPECT_TRUE(test::comesTrue("the end of the look", [&] {
            if (!rescheduler->isLooking()) return true;
            exchanged = rescheduler->exchange(plan) || exchanged;
            return false;
        }));
        return exchanged;
    }

    testing::AssertionResult isTold(const std::string& event) {
        return test::comesTrue("'" + event + "'", [&] { return rig_.hasEvent(event); });
    }

    std::atomic<std::uint32_t> threads{2};  // of the schedule that it is made; 2 are better
    std::unique_ptr<Plan> plan;
    std::unique_ptr<Rescheduler> rescheduler;

private:
    Rescheduler::Maker maker() {
        return {[this](std::span<const double>) { return schedule(threads); },
                [](Schedule schedule) {
                    return std::make_unique<Plan>(Plan{std::move(schedule), nullptr});
                }};
    }

    test::AgentRig rig_{"test"};
    TaskGraph graph_;
};

TEST_F(ReschedulerTest, OffersABetterPlanWhereItIsAsked) {
    const std::vector<std::uint32_t> tasks = plan->schedule.tasks;
    rescheduler->look();
    EXPECT_TRUE(rescheduler->isLooking());
    EXPECT_TRUE(exchanged());
    EXPECT_EQ(plan->schedule.threads, 2U);
    EXPECT_EQ(plan->schedule.tasks, tasks);
}

TEST_F(ReschedulerTest, OffersNothingWhereNoPlanIsBetter) {
    threads = 1;
    rescheduler->look();
    EXPECT_FALSE(exchanged());
    EXPECT_EQ(plan->schedule.threads, 1U);
}

TEST_F(ReschedulerTest, LooksOnceSomeTimeAfterTheLastStartup) {
    constexpr std::int64_t settling = Rescheduler::settlingTime;
    rescheduler->follow(0, 0, false);
    rescheduler->follow(0, 10 * settling, false);  // nothing has started up yet
    rescheduler->follow(1, 11 * settling, false);
    rescheduler->follow(2, 12 * settling - 1, false);
    rescheduler->follow(2, 13 * settling - 2, false);
    EXPECT_FALSE(rescheduler->isLooking());
    rescheduler->follow(2, 13 * settling - 1, false);
    EXPECT_TRUE(rescheduler->isLooking());
    EXPECT_TRUE(exchanged());

    rescheduler->follow(3, 14 * settling, false);
    rescheduler->follow(3, 20 * settling, false);
    EXPECT_FALSE(rescheduler->isLooking());
}

TEST_F(ReschedulerTest, LooksOnceAsSoonAsEveryTaskWasTimed) {
    rescheduler->follow(0, 1, false);
    EXPECT_FALSE(rescheduler->isLooking());
    rescheduler->follow(0, 2, true);
    EXPECT_TRUE(rescheduler->isLooking());
    EXPECT_TRUE(exchanged());

    rescheduler->follow(0, 3, true);
    EXPECT_FALSE(rescheduler->isLooking());
}

// It comes while the first one lasts.
TEST_F(ReschedulerTest, DoesNotForgetTheLookAfterTheLastStartup) {
    constexpr std::int64_t settling = Rescheduler::settlingTime;
    rescheduler->follow(1, 0, true);
    rescheduler->follow(1, settling, true);
    exchanged();

    rescheduler->follow(1, settling, true);

    EXPECT_TRUE(rescheduler->isLooking());
}

TEST_F(ReschedulerTest, LooksAgainWheneverItIsAsked) {
    rescheduler->look();
    EXPECT_TRUE(exchanged());
    rescheduler->look();
    EXPECT_FALSE(exchanged());  // the plan in use is as good
}

TEST_F(ReschedulerTest, TellsWhatCameOfALookAlsoOfOneThatIsUnderWay) {
    rescheduler->look();
    rescheduler->lookAndTell();
    ASSERT_TRUE(exchanged());
    EXPECT_TRUE(isTold("/test: reschedule: takes a better plan with 2 threads"));
    rescheduler->lookAndTell();
    EXPECT_FALSE(exchanged());
    EXPECT_TRUE(isTold("/test: reschedule: stays with 2 threads, no other plan is better"));
}

TEST_F(ReschedulerTest, EndsWhileItLooksOrOffers) {
    rescheduler->look();
    rescheduler.reset();
}

}  // namespace
}  // namespace cortex::cs
