// SPDX-License-Identifier: Apache-2.0
#include "lane.hpp"
#include "support/agent_rig.hpp"

#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace cortex {
namespace {

// A lane by itself: both ends played by the test.
struct Mailbox : testing::Test {
    const TypeModel types = test::commandTypes();
    const CommandTable table = commandTable(types.at("Worker"));
    CommandSender::State add{table, table.find("add"), 0, 4};
    CommandSender::State work{table, table.find("work"), 0, 4};
    std::unique_ptr<Lane> lane;

    void make(std::uint32_t capacity, bool delayed = false) {
        lane = std::make_unique<Lane>(
            Lane::Shape{0, 1, capacity, add.requestSize, add.responseSize, delayed, true},
            std::vector{&add, &work});
    }
    std::uint64_t post(double amount, std::int64_t cycle = 0) {
        *reinterpret_cast<double*>(add.request) = amount;
        return lane->post(add.command, 0, add.request, add.requestSize, {cycle, cycle * 1000});
    }
    double take(std::int64_t cycle = 0) {
        const double amount = *reinterpret_cast<const double*>(lane->requestOf(lane->front()));
        *reinterpret_cast<double*>(lane->responseOf(lane->front())) = amount * 2;
        lane->answer(lane->front(), {}, {cycle, cycle * 1000});
        lane->pop();
        return amount;
    }
    double response() const { return *reinterpret_cast<const double*>(add.response); }
};

TEST_F(Mailbox, CarriesCommandsInOrderAndTheirAnswersBack) {
    make(4);
    EXPECT_EQ(post(1), 1U);
    EXPECT_EQ(post(2), 2U);

    EXPECT_EQ(lane->number(), 1U);
    EXPECT_EQ(take(), 1);
    lane->takeAnswers();
    EXPECT_EQ(response(), 2);
    EXPECT_EQ(take(), 2);
    EXPECT_FALSE(lane->pending());
    lane->takeAnswers();

    EXPECT_EQ(response(), 4);
    EXPECT_EQ(add.answer.number, 2U);
    EXPECT_EQ(add.answered, 2U);
}

TEST_F(Mailbox, CountsTheLatencyInCyclesAndNanoseconds) {
    make(4);
    post(1, 10);
    take(13);
    lane->takeAnswers();

    EXPECT_EQ(add.answer.latencyCycles, 3);
    EXPECT_EQ(add.answer.latency, 3000);
}

TEST_F(Mailbox, LatencyIsNeverNegativeWhereTheReceiversChunkBeganEarlier) {
    make(4);
    post(1, 10);
    lane->answer(lane->front(), {}, {10, 9000});
    lane->pop();
    lane->takeAnswers();

    EXPECT_EQ(add.answer.latency, 0);
}

TEST_F(Mailbox, HoldsItsCapacityUntilTheSenderHasTakenTheAnswers) {
    make(3);
    for (int i = 1; i <= 3; ++i) EXPECT_NE(post(i), 0U);
    EXPECT_EQ(post(4), 0U);
    take();
    EXPECT_EQ(post(4), 0U);  // room for the answer is kept
    lane->takeAnswers();
    EXPECT_EQ(post(4), 4U);
    EXPECT_EQ(post(5), 0U);
}

TEST_F(Mailbox, GoesRoundForEverWithoutLosingOrRepeating) {
    make(5);
    std::uint64_t sent = 0, taken = 0;
    for (int round = 0; round < 200; ++round) {
        for (int i = 0; i < round % 4 + 1; ++i) {
            if (post(static_cast<double>(sent + 1)) != 0) ++sent;
        }
        for (int i = 0; i < round % 3 + 1 && lane->pending(); ++i) {
            EXPECT_EQ(take(), static_cast<double>(++taken));
        }
        lane->takeAnswers();
        EXPECT_EQ(add.answered, taken);
    }
    EXPECT_GT(taken, 300U);
}

TEST_F(Mailbox, DelayedEndsSeeEachOtherOnlyAfterTheLatch) {
    make(2, true);
    post(1);
    EXPECT_FALSE(lane->pending());
    lane->latch();
    EXPECT_TRUE(lane->pending());
    post(2);
    take();
    EXPECT_FALSE(lane->pending());  // the second came after the latch

    lane->takeAnswers();
    EXPECT_EQ(add.answered, 0U);
    EXPECT_EQ(post(3), 0U);  // full, however far the receiver has come in this cycle
    lane->latch();
    EXPECT_EQ(post(3), 0U);
    lane->takeAnswers();
    EXPECT_EQ(add.answered, 1U);
    EXPECT_EQ(post(3), 3U);
    EXPECT_EQ(take(), 2);
}

TEST_F(Mailbox, WordsOfAnAnswerGoWithIt) {
    make(4);
    post(1);
    post(2);
    lane->answer(lane->front(), {Outcome::Rejected, Reason::Busy, "later"}, {});
    lane->pop();
    lane->takeAnswers();
    EXPECT_EQ(add.answer.reason, Reason::Busy);
    EXPECT_EQ(add.answer.why.view(), "later");

    take();
    lane->takeAnswers();
    EXPECT_EQ(add.answer.outcome, Outcome::Done);
    EXPECT_EQ(add.answer.why.view(), "");
}

TEST_F(Mailbox, LastAnswerOfALongCommandComesAfterOthersThatWereSentLater) {
    make(4);
    lane->post(work.command, 1, work.request, work.requestSize, {});
    post(7);
    lane->answer(lane->front(), {Outcome::Running, Reason::None, {}}, {});
    lane->pop();
    take();
    lane->takeAnswers();
    EXPECT_EQ(work.answer.outcome, Outcome::Running);
    EXPECT_EQ(add.answer.outcome, Outcome::Done);

    const std::int64_t result = 99;
    lane->finish({1, 5, 5000, Outcome::Done, Reason::None, {}}, 1,
                 reinterpret_cast<const std::byte*>(&result), 8);
    lane->takeAnswers();

    EXPECT_EQ(work.answer.outcome, Outcome::Done);
    EXPECT_EQ(work.answer.latencyCycles, 5);
    EXPECT_EQ(*reinterpret_cast<const std::int64_t*>(work.response), 99);
    EXPECT_EQ(work.answered, 1U);
}

TEST_F(Mailbox, LastAnswersOfADelayedLaneWaitForTheLatch) {
    make(4, true);
    lane->post(work.command, 1, work.request, work.requestSize, {});
    lane->latch();
    lane->answer(lane->front(), {Outcome::Running, Reason::None, {}}, {});
    lane->pop();
    lane->finish({1, 0, 0, Outcome::Done, Reason::None, {}}, 1, nullptr, 0);
    lane->takeAnswers();
    EXPECT_EQ(work.answered, 0U);

    lane->latch();
    lane->takeAnswers();

    EXPECT_EQ(work.answered, 1U);
    EXPECT_EQ(work.answer.outcome, Outcome::Done);
}

TEST_F(Mailbox, SlotOfASmallCommandIsOneCacheLine) {
    EXPECT_LE(sizeof(LaneSlot) + 2 * 8 + 2 * 8, 64U);
    EXPECT_EQ(alignof(Lane), 64U);
}

TEST_F(Mailbox, RefusalsInARowStartOnce) {
    make(4);
    EXPECT_FALSE(lane->startsRefusing(false));
    EXPECT_TRUE(lane->startsRefusing(true));
    EXPECT_FALSE(lane->startsRefusing(true));
    EXPECT_FALSE(lane->startsRefusing(false));
    EXPECT_TRUE(lane->startsRefusing(true));
}

TEST(LatencyBucket, GrowsWithTheLatencyAndHoldsIt) {
    std::uint32_t last = 0;
    for (std::int64_t ns = 0; ns < 1'000'000'000; ns = ns * 9 / 8 + 1) {
        const std::uint32_t bucket = latencyBucket(ns);
        EXPECT_GE(bucket, last);
        EXPECT_LT(static_cast<double>(ns), latencyOfBucket(bucket) * 1000);
        EXPECT_LE(latencyOfBucket(bucket) * 1000, static_cast<double>(ns) * 1.07 + 1);
        last = bucket;
    }
    EXPECT_EQ(latencyBucket(-5), 0U);
    EXPECT_EQ(latencyBucket(INT64_MAX), latencyBuckets - 1);
}

}  // namespace
}  // namespace cortex
