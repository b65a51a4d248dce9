// SPDX-License-Identifier: Apache-2.0
// What the window knows of the loops of agents, and of what they did in the last minutes.
#include "model/loop_metrics.hpp"

#include "gui/measured_agent.hpp"
#include "model/loop_history.hpp"

#include <QStringList>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace gui;

QStringList texts(const LoopFigure& figure) {
    QStringList all;
    for (const QString& each : figure.texts) all << each;
    return all;
}

TEST(LoopMetrics, HaveTheNumbersThatTheLoopMeasured) {
    MadeAgent robot = clusterNamed("robot");
    measure(robot, "/robot");
    const LoopMetrics loop = loopMetrics(robot.now());
    EXPECT_TRUE(loop.live);
    EXPECT_EQ(texts(loop.duty), (QStringList{"12.00", "10.00", "20.00", "40.00", "90.00"}));
    EXPECT_EQ(loop.duty.unit, "%");
    EXPECT_EQ(texts(loop.times[LoopMetrics::Jitter]),
              (QStringList{"1.2", "1.0", "2.0", "4.0", "9.0"}));
    EXPECT_EQ(loop.times[LoopMetrics::Jitter].unit, QString::fromUtf8("µs"));
    EXPECT_EQ(loop.times[LoopMetrics::Cycle].numbers[LoopFigure::P999], 1004);
}

TEST(LoopMetrics, WhatIsNotMeasuredIsNotKnownAndNever0) {
    MadeAgent plain = clusterNamed("plain", "Agent");
    const LoopMetrics loop = loopMetrics(plain.now());
    EXPECT_EQ(loop.duty.unknown, "not known: not measured");
    EXPECT_FALSE(loop.duty.numbers[LoopFigure::Max]);
    EXPECT_EQ(loop.duty.texts[LoopFigure::Max], QString::fromUtf8("—"));

    MadeAgent robot = clusterNamed("robot");
    EXPECT_EQ(loopMetrics(robot.now()).duty.unknown, "not known: no cycle yet");
    measure(robot, "/robot");
    const LoopFigure latency = loopMetrics(robot.now()).times[LoopMetrics::Command];
    EXPECT_EQ(latency.unknown, "no command yet");
    EXPECT_FALSE(latency.numbers[LoopFigure::P99]);
}

TEST(LoopMetrics, AJitterOf0IsKnownOnceCyclesWereMeasured) {
    MadeAgent robot = clusterNamed("robot");
    measure(robot, "/robot");
    for (const char* each : {"jitterLast", "jitterP50", "jitterP99", "jitterP999", "jitterMax"})
        robot.put("/robot", each, 0.0);
    const LoopFigure jitter = loopMetrics(robot.now()).times[LoopMetrics::Jitter];
    EXPECT_EQ(jitter.unknown, "");
    EXPECT_EQ(jitter.numbers[LoopFigure::Max], 0);
}

TEST(LoopMetrics, OfALostAgentAreTheLastOnesInBrackets) {
    MadeAgent robot = clusterNamed("robot");
    measure(robot, "/robot");
    const LoopMetrics loop = loopMetrics(robot.now("lost"));
    EXPECT_FALSE(loop.live);
    EXPECT_EQ(loop.duty.texts[LoopFigure::Last], "[12.00]");
}

TEST(LogAxis, HasWholeDecadesAroundAllThatIsMeasured) {
    LoopFigure figure;
    figure.numbers[LoopFigure::P50] = 30;
    figure.numbers[LoopFigure::Max] = 2'500;
    const LogAxis axis = LogAxis::around({figure});
    EXPECT_EQ(axis.from, 1);
    EXPECT_EQ(axis.to, 4);
    EXPECT_DOUBLE_EQ(axis.shareOf(10), 0);
    EXPECT_DOUBLE_EQ(axis.shareOf(10'000), 1);
    EXPECT_DOUBLE_EQ(axis.shareOf(0), 0);
    EXPECT_EQ(axis.label(1), QString::fromUtf8("10 µs"));
    EXPECT_EQ(axis.label(4), "10 ms");

    figure.numbers[LoopFigure::P50] = 0.04;
    EXPECT_EQ(LogAxis::around({figure}).label(0), QString::fromUtf8("≤ 1 µs"));
}

std::shared_ptr<Frame> at(double seconds, AgentFrame agent) {
    auto frame = frameOf({std::move(agent)});
    frame->seconds = seconds;
    return frame;
}

TEST(LoopHistory, ACounterHasItsChangeInTheLastMinute) {
    MadeAgent robot = clusterNamed("robot");
    LoopHistory history;
    const auto count = [&](double seconds, std::int64_t overflows) {
        robot.put("/robot", "overflowCount", overflows);
        AgentFrame now = robot.now();
        history.add(*at(seconds, now));
        return history.change(now, Counter::Overflows);
    };
    EXPECT_FALSE(count(0, 5)) << "nothing was seen before";
    EXPECT_EQ(count(2, 8)->more, 3);
    EXPECT_EQ(count(2, 8)->seconds, 2);
    EXPECT_EQ(count(61, 9)->more, 1) << "what was seen more than a minute ago is left out";
    EXPECT_FALSE(count(600, 9)) << "all of it is older than a minute";
    EXPECT_EQ(count(620, 9)->more, 0);
}

TEST(LoopHistory, AnotherStartOfAnAgentHasNothingBehindIt) {
    MadeAgent robot = clusterNamed("robot");
    LoopHistory history;
    AgentFrame first = robot.now();
    history.add(*at(0, first));
    history.add(*at(5, first));
    AgentFrame next = robot.now();
    next.status.epoch = first.status.epoch + 1;
    history.add(*at(6, next));
    EXPECT_FALSE(history.change(next, Counter::Commands));
    EXPECT_EQ(history.of(next).size(), 1U);
}

TEST(LoopHistory, ForgetsWhatIsOlderThanTenMinutes) {
    MadeAgent robot = clusterNamed("robot");
    LoopHistory history;
    const AgentFrame now = robot.now();
    for (int time = 0; time <= 700; ++time) history.add(*at(time, now));
    EXPECT_EQ(history.of(now).front().time, 100);
    EXPECT_EQ(history.of(now).back().time, 700);
}

}  // namespace
}  // namespace cortex::test
