// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/error.hpp"

#include "support/probe.hpp"

#include <gtest/gtest.h>

namespace cortex::test {

namespace {

TEST(KeptState, IsRestoredIntoAnotherSimplexThatGoesOnFromThere) {
    ProbeCluster cluster;
    Probe& first = cluster.probe("/first");
    Probe& second = cluster.probe("/second");
    double firstSum = 0, secondSum = 0;
    first.onLoopEnd = [&](Probe&, const Tick&) { firstSum += 1; };
    first.onKeep = [&](Archive& archive) { archive & firstSum; };
    second.onLoopEnd = [&](Probe&, const Tick&) { secondSum -= 1; };
    second.onKeep = [&](Archive& archive) { archive & secondSum; };
    cluster.start();
    cluster.step(5);

    second.restoreState(first.savedState());
    cluster.step(2);

    EXPECT_EQ(firstSum, 7);
    EXPECT_EQ(secondSum, 3);
}

TEST(KeptState, ThatDoesNotFitIsRefusedAndChangesNothing) {
    ProbeCluster cluster;
    Probe& probe = cluster.probe("/a");
    double sum = 1;
    std::int64_t count = 2;
    bool more = false;
    probe.onKeep = [&](Archive& archive) {
        archive & sum;
        if (more) archive & count;
    };
    cluster.start();
    const std::vector<std::byte> saved = probe.savedState();
    sum = 5;
    more = true;

    try {
        probe.restoreState(saved);
        FAIL() << "it was restored";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(),
                     "/a: what is kept, value 2: nothing more was saved; nothing was restored");
    }
    EXPECT_EQ(sum, 5);
}

TEST(KeptState, OfASimplexThatKeepsNothingIsEmpty) {
    ProbeCluster cluster;
    Probe& probe = cluster.probe("/a");
    cluster.start();

    EXPECT_TRUE(probe.savedState().empty());
    EXPECT_NO_THROW(probe.restoreState({}));
}

TEST(KeptState, IsNotSavedWhileAClockRunsTheLoop) {
    ProbeCluster cluster;
    Probe& probe = cluster.probe("/a");
    cluster.cluster->setTriggerSource<cs::InternalClock>(std::chrono::milliseconds{1});
    cluster.start();

    EXPECT_THROW(probe.savedState(), Error);
    EXPECT_THROW(probe.restoreState({}), Error);
    cluster.cluster->stop();  // before its hooks are forgotten
}

}  // namespace

}  // namespace cortex::test
