// SPDX-License-Identifier: Apache-2.0
#include "cortex/cs/io_exchange.hpp"

#include "cortex/core/error.hpp"

#include "cs/io_drive.hpp"
#include "threads/realtime_thread.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include <poll.h>
#include <pthread.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace cortex::test {

namespace {

using namespace std::chrono_literals;

TEST(Newest, IsWholeAndNeverOlderThanTheOneBefore) {
    struct Pair {
        std::int64_t number = 0, again = 0;
    };
    constexpr std::int64_t last = 200'000;
    cs::Newest<Pair> newest;
    std::thread writer{[&] {
        for (std::int64_t i = 1; i <= last; ++i) newest.put({i, i});
    }};
    std::int64_t before = 0;
    const auto end = std::chrono::steady_clock::now() + patience;
    while (before < last && std::chrono::steady_clock::now() < end) {
        if (!newest.take()) continue;
        const Pair& pair = newest.value();
        ASSERT_EQ(pair.number, pair.again);
        ASSERT_GT(pair.number, before);
        before = pair.number;
    }
    writer.join();
    EXPECT_EQ(before, last) << "it waits in vain";
    EXPECT_FALSE(newest.take());
}

TEST_F(IoExchange, BringsAValueToTheHookAndCountsItsAgeInNominalTime) {
    start(obeying());
    cluster.step();
    EXPECT_EQ(quality(), Quality::Lost) << "before the first value";
    EXPECT_TRUE(cluster.events().empty());

    onThread([](Line& line) { line.put({0.25, 1}); });
    cluster.step();
    EXPECT_EQ(drive.seen.position, 0.25);
    EXPECT_EQ(drive.ageSeen, 0);
    EXPECT_EQ(quality(), Quality::Good);
    cluster.step(3);

    EXPECT_EQ(drive.ageSeen, 3'000'000);
    EXPECT_EQ(cluster.number("/axis", "position"), 0.25);
    const Image image = cluster.cluster->image();
    EXPECT_EQ(image.nominalTime() - image.state(image.structure().find("/axis")).time, 3'000'000);
}

TEST_F(IoExchange, LosesADeviceWhoseThreadIsSilentForTooLongAndSaysWhenItIsBack) {
    start(obeying());
    onThread([](Line& line) { line.put({1, 1}); });
    cluster.step(6);
    EXPECT_EQ(quality(), Quality::Good) << "5 ms old";
    cluster.step();
    EXPECT_EQ(quality(), Quality::Lost);
    EXPECT_TRUE(drive.lost);
    cluster.step();
    EXPECT_TRUE(cluster.hasEvent(
        "/drive: the device is lost: thread io-drive has given no value for 0.006 s"));

    onThread([](Line& line) { line.put({2, 2}); });
    cluster.step(2);

    EXPECT_EQ(quality(), Quality::Good);
    EXPECT_TRUE(cluster.hasEvent("/drive: the device is back"));
}

TEST_F(IoExchange, LosesADeviceAtOnceThatTheThreadCallsLostAndKeepsItsLastValue) {
    start(obeying());
    onThread([](Line& line) { line.put({1, 1}); });
    cluster.step();
    onThread([](Line& line) { line.lose("the plug was pulled"); });
    cluster.step(2);

    EXPECT_EQ(quality(), Quality::Lost);
    EXPECT_EQ(drive.seen.position, 1);
    EXPECT_EQ(drive.ageSeen, 2'000'000) << "what says that it is lost does not make it younger";
    EXPECT_TRUE(cluster.hasEvent("/drive: the device is lost: the plug was pulled"));
    onThread([](Line& line) { line.lose("the plug was pulled"); });
    cluster.step(2);
    EXPECT_EQ(cluster.events().size(), 1U) << "the same reason again";
    onThread([](Line& line) { line.lose("no such port"); });
    cluster.step(2);
    EXPECT_TRUE(cluster.hasEvent("/drive: the device is lost: no such port"));
}

TEST_F(IoExchange, TurnsAnExceptionOfTheThreadIntoAFaultAndBeginsAnewWhenItIsCleared) {
    start(obeying());
    onThread([](Line& line) {
        line.put({1, 1});
        throw Error("/dev/ttyS9: no such device");
    });
    stepUntil([&] { return cluster.state("/drive") == State::Fault; });
    cluster.step();

    EXPECT_EQ(cluster.integer("/drive", "faultCode"), -8);
    EXPECT_TRUE(cluster.hasEvent("/drive: fault -8: /dev/ttyS9: no such device"));
    EXPECT_EQ(quality(), Quality::Lost);
    EXPECT_EQ(drive.talks, 1);

    EXPECT_EQ(cluster.call("/drive", "clearFaults").outcome, Outcome::Done);
    stepUntil([&] {
        EXPECT_EQ(quality(), Quality::Lost) << "its old value is no present one";
        return drive.talks == 2;
    });
    onThread([](Line& line) { line.put({3, 2}); });
    cluster.step();
    EXPECT_EQ(quality(), Quality::Good);
    EXPECT_EQ(drive.seen.position, 3);
}

TEST_F(IoExchange, TakesAThreadThatReturnsUnaskedForAFaultEachTime) {
    start([](Line&) {});
    for (int i = 1; i <= 3; ++i) {
        stepUntil([&] { return cluster.state("/drive") == State::Fault; });
        EXPECT_EQ(drive.talks, i);
        cluster.step();
        EXPECT_EQ(cluster.call("/drive", "clearFaults").outcome, Outcome::Done);
        stepUntil([&] { return drive.talks == i + 1; });
    }
    EXPECT_TRUE(cluster.hasEvent("communicate() returned, although the line was not ending"));
}

TEST_F(IoExchange, GivesTheThreadTheNewestDemandAndThatOfTheLastCycleAtTheEnd) {
    std::int64_t last = 0, present = 0;
    bool hadNone = false;
    start([&](Line& line) {
        hadNone = line.demand() == nullptr;
        obeying()(line);
        last = line.demand()->cycle;
    });
    onThread([](Line&) {});
    cluster.step(4);
    onThread([&](Line& line) {
        present = line.demand()->cycle;
        EXPECT_GE(line.demandAge(), 0ns);
    });
    EXPECT_TRUE(hadNone);
    EXPECT_EQ(present, 4);

    cluster.step(3);
    cluster.cluster->stop();

    EXPECT_GE(last, 7);
    EXPECT_EQ(last, cluster.cluster->image().cycle());
}

TEST_F(IoExchange, EndsAThreadThatPollsItsDescriptorAndTheEndBesideIt) {
    int device[2] = {-1, -1};
    ASSERT_EQ(pipe(device), 0);
    std::string name(16, '\0');
    bool isEnding = false;
    start([&](Line& line) {
        pthread_getname_np(pthread_self(), name.data(), name.size());
        pollfd both[] = {{device[0], POLLIN, 0}, {line.endDescriptor(), POLLIN, 0}};
        while (!line.isEnding()) poll(both, 2, -1);
        isEnding = !line.waitFor(1h);
    });
    stepUntil([&] { return drive.talks == 1; });

    cluster.cluster->stop();

    EXPECT_TRUE(isEnding);
    EXPECT_EQ(name.c_str(), std::string{"io-drive"});
    close(device[0]);
    close(device[1]);
}

TEST_F(IoExchange, BeginsNoThreadForAModelThatIsRefused) {
    cluster.tree.add<IoDrive>("/other", "Drive");  // without what it must be related to

    EXPECT_THROW(start([](Line&) {}), ModelError);

    EXPECT_EQ(drive.talks, 0);
}

TEST_F(IoExchange, NeverHasARealtimePriority) {
    int policy = -1;
    std::thread{[&] {
        const sched_param low{1};
        if (pthread_setschedparam(pthread_self(), SCHED_FIFO, &low) != 0) return;
        std::thread{[&] {
            cs::configureBlockingThread("io-drive");
            sched_param parameter{};
            pthread_getschedparam(pthread_self(), &policy, &parameter);
        }}.join();
    }}.join();
    if (policy < 0) GTEST_SKIP() << "needs the right to a real-time priority (CAP_SYS_NICE)";
    EXPECT_EQ(policy, SCHED_OTHER);
}

using IoExchangeDeathTest = IoExchange;

TEST_F(IoExchangeDeathTest, NamesTheThreadThatDoesNotReturnAndEndsTheProcess) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(
        {
            start([](Line&) { pause(); });
            stepUntil([&] { return drive.talks == 1; });
            cluster.cluster->stop();
        },
        testing::ExitedWithCode(3),
        "cluster test does not stop: thread io-drive of /drive does not return from communicate");
}

}  // namespace

}  // namespace cortex::test
