// SPDX-License-Identifier: Apache-2.0
#include "commands/lane_block.hpp"
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
    std::unique_ptr<LaneBlock> block;
    Lane* lane = nullptr;

    void make(std::uint32_t capacity, bool delayed = false, std::uint32_t kept = 0) {
        Lane::Shape shape{0, 1, capacity, add.requestSize(), add.responseSize(), delayed, true};
        shape.kept = kept;
        block = std::make_unique<LaneBlock>(std::vector<LaneBlock::Plan>{{shape, {&add, &work}}});
        lane = block->lanes().front();
    }
    std::int64_t cycle = 1;

    ChunkClock clock() const { return {cycle, cycle * 1000}; }
    bool post(double amount, std::uint32_t beyond = 0) {
        *reinterpret_cast<double*>(add.request()) = amount;
        lane->beginSending(cycle);
        return lane->post(add.command, 0, add.request(), add.requestSize(), clock(), beyond);
    }
    bool pending() const { return lane->pending(cycle) > 0; }
    void answer(const Verdict& verdict) {
        lane->beginReceiving(cycle);
        lane->answer(lane->front(), verdict, clock());
        lane->pop();
    }
    double take() {
        const double amount = *reinterpret_cast<const double*>(lane->requestOf(lane->front()));
        *reinterpret_cast<double*>(lane->responseOf(lane->front())) = amount * 2;
        answer({});
        return amount;
    }
    void takeAnswers() { lane->takeAnswers(cycle); }
    double response() { return *reinterpret_cast<const double*>(add.response()); }
};

TEST_F(Mailbox, CarriesCommandsInOrderAndTheirAnswersBack) {
    make(4);
    EXPECT_TRUE(post(1));
    EXPECT_TRUE(post(2));

    EXPECT_EQ(lane->number(), 1U);
    EXPECT_EQ(take(), 1);
    takeAnswers();
    EXPECT_EQ(response(), 2);
    EXPECT_EQ(take(), 2);
    EXPECT_FALSE(pending());
    takeAnswers();

    EXPECT_EQ(response(), 4);
    EXPECT_EQ(add.answer.number, 2U);
    EXPECT_EQ(add.answeredCount(), 2U);
}

TEST_F(Mailbox, CountsTheLatencyInCyclesAndNanoseconds) {
    make(4);
    cycle = 10;
    post(1);
    cycle = 13;
    take();
    takeAnswers();

    EXPECT_EQ(add.answer.latencyCycles, 3);
    EXPECT_EQ(add.answer.latency, 3000);
}

TEST_F(Mailbox, LatencyIsNeverNegativeWhereTheReceiversChunkBeganEarlier) {
    make(4);
    cycle = 10;
    post(1);
    lane->answer(lane->front(), {}, {10, 9000});
    lane->pop();
    takeAnswers();

    EXPECT_EQ(add.answer.latency, 0);
}

TEST_F(Mailbox, HoldsItsCapacityUntilTheSenderHasTakenTheAnswers) {
    make(3);
    for (int i = 1; i <= 3; ++i) EXPECT_TRUE(post(i));
    EXPECT_FALSE(post(4));
    take();
    EXPECT_FALSE(post(4));  // room for the answer is kept
    takeAnswers();
    EXPECT_TRUE(post(4));
    EXPECT_FALSE(post(5));
}

TEST_F(Mailbox, GoesRoundForEverWithoutLosingOrRepeating) {
    make(5);
    std::uint64_t sent = 0, taken = 0;
    for (int round = 0; round < 200; ++round) {
        for (int i = 0; i < round % 4 + 1; ++i) {
            if (post(static_cast<double>(sent + 1))) ++sent;
        }
        for (int i = 0; i < round % 3 + 1 && pending(); ++i) {
            EXPECT_EQ(take(), static_cast<double>(++taken));
        }
        takeAnswers();
        EXPECT_EQ(add.answeredCount(), taken);
    }
    EXPECT_GT(taken, 300U);
}

TEST_F(Mailbox, DelayedEndsSeeEachOtherOnlyInTheNextCycle) {
    make(2, true);
    post(1);
    EXPECT_FALSE(pending());
    ++cycle;
    EXPECT_TRUE(pending());
    post(2);
    take();
    EXPECT_FALSE(pending());  // the second came in this cycle

    takeAnswers();
    EXPECT_EQ(add.answeredCount(), 0U);
    EXPECT_FALSE(post(3));  // full, however far the receiver has come in this cycle
    ++cycle;
    EXPECT_FALSE(post(3));
    takeAnswers();
    EXPECT_EQ(add.answeredCount(), 1U);
    EXPECT_TRUE(post(3));
    EXPECT_EQ(take(), 2);
}

// Counters of cycles are compared modulo 2^32.
TEST_F(Mailbox, LaneThatStoodStillForAWholeTurnOfTheCycleCounterRepeatsNothing) {
    make(2, true);
    post(1);
    ++cycle;
    take();
    ++cycle;
    takeAnswers();
    EXPECT_EQ(add.answeredCount(), 1U);

    for (cycle = 0xffff'ffff; cycle < 0x1'0000'0008; ++cycle) {
        EXPECT_FALSE(pending()) << cycle;
        takeAnswers();
        EXPECT_EQ(add.answeredCount(), 1U) << cycle;
    }
    EXPECT_TRUE(post(2));
    ++cycle;
    EXPECT_EQ(take(), 2);
}

TEST_F(Mailbox, WordsOfAnAnswerGoWithIt) {
    make(4);
    post(1);
    post(2);
    answer({Outcome::Rejected, Reason::Busy, "later"});
    takeAnswers();
    EXPECT_EQ(add.answer.reason, Reason::Busy);
    EXPECT_EQ(add.answer.why.view(), "later");

    take();
    takeAnswers();
    EXPECT_EQ(add.answer.outcome, Outcome::Done);
    EXPECT_EQ(add.answer.why.view(), "");
}

TEST_F(Mailbox, PlacesThatAreKeptAreForWhoMayTakeThem) {
    make(3, false, 2);
    EXPECT_TRUE(post(1));
    EXPECT_FALSE(post(2));
    EXPECT_TRUE(post(2, 1));
    EXPECT_FALSE(post(3, 1));
    EXPECT_TRUE(post(3, 2));
    EXPECT_FALSE(post(4, 2));
}

TEST_F(Mailbox, LastAnswerOfALongCommandComesAfterOthersThatWereSentLater) {
    make(4);
    lane->beginSending(cycle);
    lane->post(work.command, 1, work.request(), work.requestSize(), clock());
    post(7);
    answer({Outcome::Running, Reason::None, {}});
    take();
    takeAnswers();
    EXPECT_EQ(work.answer.outcome, Outcome::Running);
    EXPECT_EQ(add.answer.outcome, Outcome::Done);

    const std::int64_t result = 99;
    lane->finals().add({1, 5, 5000, Outcome::Done, Reason::None, {}}, 1,
                       reinterpret_cast<const std::byte*>(&result), 8, cycle);
    takeAnswers();

    EXPECT_EQ(work.answer.outcome, Outcome::Done);
    EXPECT_EQ(work.answer.latencyCycles, 5);
    EXPECT_EQ(*reinterpret_cast<const std::int64_t*>(work.response()), 99);
    EXPECT_EQ(work.answeredCount(), 1U);
}

TEST_F(Mailbox, LastAnswersOfADelayedLaneWaitForTheNextCycle) {
    make(4, true);
    lane->beginSending(cycle);
    lane->post(work.command, 1, work.request(), work.requestSize(), clock());
    ++cycle;
    answer({Outcome::Running, Reason::None, {}});
    lane->finals().add({1, 0, 0, Outcome::Done, Reason::None, {}}, 1, nullptr, 0, cycle);
    takeAnswers();
    EXPECT_EQ(work.answeredCount(), 0U);

    ++cycle;
    takeAnswers();

    EXPECT_EQ(work.answeredCount(), 1U);
    EXPECT_EQ(work.answer.outcome, Outcome::Done);
}

TEST_F(Mailbox, CommandOfOneNumberAndItsAnswerTouchACacheLineAtEachEndAndOneBetween) {
    EXPECT_LE(sizeof(LaneSlot) + 2 * 8, 64U);
    EXPECT_EQ(alignof(Lane), 64U);
    EXPECT_FALSE(add.storedExternally());
    const auto* begin = reinterpret_cast<const std::byte*>(&add);
    EXPECT_LE(reinterpret_cast<const std::byte*>(&add.answer.reason) - begin, 63);
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
