// SPDX-License-Identifier: Apache-2.0
#include "cortex/cs/slow_work.hpp"

#include "cortex/core/error.hpp"

#include "support/waiting.hpp"

#include <atomic>
#include <future>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

void waitFor(const cs::SlowWork& work) {
    waitUntil("the end of the work", [&] { return !work.isRunning(); });
}

TEST(SlowWork, IsDoneOnAnotherThreadAndAgainWhenAskedAgain) {
    std::thread::id own;
    int done = 0;
    cs::SlowWork work{[&] {
        own = std::this_thread::get_id();
        ++done;
    }};
    for (int i = 1; i <= 3; ++i) {
        EXPECT_TRUE(work.begin());
        waitFor(work);
        EXPECT_EQ(done, i);
        EXPECT_EQ(work.failure(), "");
    }
    EXPECT_NE(own, std::this_thread::get_id());
}

TEST(SlowWork, SaysWhatItThrew) {
    bool throws = true;
    cs::SlowWork work{[&throws] {
        if (throws) throw Error{"there is no file"};
    }};
    EXPECT_TRUE(work.begin());
    waitFor(work);
    EXPECT_EQ(work.failure(), "there is no file");
    throws = false;
    EXPECT_TRUE(work.begin());
    waitFor(work);
    EXPECT_EQ(work.failure(), "");
}

TEST(SlowWork, IsNotBegunTwiceAtOnce) {
    std::promise<void> mayEnd;
    cs::SlowWork work{[&] { mayEnd.get_future().wait(); }};
    EXPECT_TRUE(work.begin());
    EXPECT_FALSE(work.begin());
    EXPECT_TRUE(work.isRunning());
    mayEnd.set_value();
    waitFor(work);
}

TEST(SlowWork, OfManyIsDoneOneAtATime) {
    std::atomic<int> atOnce{0}, most{0}, done{0};
    std::vector<cs::SlowWork> all;
    for (int i = 0; i < 20; ++i) {
        all.emplace_back([&] {
            most = std::max(most.load(), ++atOnce);
            ++done;
            --atOnce;
        });
    }
    for (cs::SlowWork& each : all) EXPECT_TRUE(each.begin());
    for (const cs::SlowWork& each : all) waitFor(each);
    EXPECT_EQ(most, 1);
    EXPECT_EQ(done, 20);
}

TEST(SlowWork, EndsWithItsOwnerAlsoWhileItRuns) {
    std::promise<void> begun;
    std::atomic<bool> ended{false};
    auto work = std::make_unique<cs::SlowWork>([&] {
        begun.set_value();
        std::this_thread::yield();
        ended = true;
    });
    EXPECT_TRUE(work->begin());
    begun.get_future().wait();
    work.reset();
    EXPECT_TRUE(ended);
}

TEST(SlowWork, ThatIsBoundToNothingIsNeverBegun) {
    cs::SlowWork work;
    EXPECT_FALSE(work.begin());
    EXPECT_FALSE(work.isRunning());
    EXPECT_EQ(work.failure(), "");
}

}  // namespace
}  // namespace cortex::test
