// SPDX-License-Identifier: Apache-2.0
// What a thread beside the tick knows of the loop's pace, and what hooks ask it to do.
#include "cortex/core/error.hpp"

#include "cs/io_drive.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include <gtest/gtest.h>

namespace cortex::test {

namespace {

using namespace std::chrono_literals;
using Clock = cs::Pace::Clock;

// Stepped, but with deadlines: that of cycle k is at k ms.
class StepsWithDeadlines final : public cs::TriggerSource {
public:
    void start() override { steps.start(); }
    cs::Trigger waitForTick() override {
        ++begun_;
        return steps.waitForTick();
    }
    void interrupt() override { steps.interrupt(); }
    std::int64_t period() const override { return steps.period(); }
    std::int64_t nextDeadline() const override { return (begun_ + 1) * period(); }
    bool realTime() const override { return false; }

    cs::ManualTrigger steps{1ms};

private:
    std::int64_t begun_ = 0;
};

class IoPace : public IoExchange {
protected:
    // As the thread sees it with the newest demand.
    cs::Pace pace() {
        cs::Pace seen;
        onThread([&](Line& line) {
            line.demand();
            seen = line.pace();
        });
        return seen;
    }
};

TEST(Pace, TellsWhichRunIsDueNextAlsoWhenTheLoopIsLate) {
    const Clock::time_point next{10ms};
    const cs::Pace pace{1, next, 2ms};
    EXPECT_EQ(pace.after(Clock::time_point{3ms}), next);
    EXPECT_EQ(pace.after(next - 1ns), next);
    EXPECT_EQ(pace.after(next), next + 2ms);
    EXPECT_EQ(pace.after(next + 1ms), next + 2ms);
    EXPECT_EQ(pace.after(next + 2ms), next + 4ms);
    EXPECT_EQ(pace.after(next + 101ms), next + 102ms);
}

TEST_F(IoPace, KnowsThePeriodBeforeTheFirstDemandAndNoDeadlineOfASteppedLoop) {
    start(obeying());
    const cs::Pace first = pace();
    EXPECT_EQ(first.cycle, 0);
    EXPECT_EQ(first.period, 1ms);
    EXPECT_FALSE(first.isKnown());

    cluster.step(3);
    EXPECT_EQ(pace().cycle, 3);
    EXPECT_EQ(pace().period, 1ms);
    EXPECT_FALSE(pace().isKnown());
}

TEST_F(IoPace, ComesWithEachDemandAndSaysWhenTheNextRunOfTheSimplexIsDue) {
    cs::ManualTrigger& steps = cluster.cluster->setTriggerSource<StepsWithDeadlines>().steps;
    drive.runEvery(4, 0);
    start(obeying());
    steps.step();
    const cs::Pace first = pace();
    EXPECT_EQ(first.cycle, 1);
    EXPECT_EQ(first.period, 4ms);
    EXPECT_EQ(first.next, Clock::time_point{5ms});

    steps.step(3);
    EXPECT_EQ(pace().cycle, 1) << "it has not run again";
    steps.step();
    EXPECT_EQ(pace().cycle, 5);
    EXPECT_EQ(pace().next, Clock::time_point{9ms});
}

TEST_F(IoPace, LetsTheThreadWaitUntilATimeOrTheEnd) {
    bool isPast = false, waited = true;
    start([&](Line& line) {
        isPast = line.waitUntil(Clock::now() - 1s);
        ++turn;
        waited = line.waitUntil(Clock::now() + 1h);
    });
    stepUntil([this] { return turn == 1; });
    EXPECT_TRUE(isPast);

    cluster.cluster->stop();
    EXPECT_FALSE(waited);
}

class IoHanging : public IoExchange {
protected:
    std::atomic<bool> hangs{false};
};

TEST_F(IoHanging, IsSeenOfALoopInRealTimeThatGivesNoDemandAndNeverOfASteppedOne) {
    start(obeying());
    cluster.step();
    onThread([](Line& line) {
        line.demand();
        line.waitFor(3ms);
        EXPECT_GE(line.demandAge(), 3ms);
        EXPECT_FALSE(line.loopHangs(1ms));
    });
}

TEST_F(IoHanging, IsSeenOfALoopWhoseTicksFail) {
    auto& ticks = cluster.cluster->setTriggerSource<cs::ExternalTrigger>(1ms);
    start([&](Line& line) {
        while (line.waitFor(1ms)) hangs = line.demand() != nullptr && line.loopHangs(50ms);
    });
    ticks.notify();
    waitUntil("a loop that is seen to hang", [&] { return hangs.load(); });
    const auto goesOn = [&] {
        ticks.notify();
        return !hangs;
    };
    waitUntil("a loop that goes on", goesOn);
}

using IoStaleness = IoExchange;

TEST_F(IoStaleness, IsSeenBetweenGoodAndLostAndTellsNothing) {
    drive.stale = 2ms;
    start(obeying());
    onThread([](Line& line) { line.put({1, 1}); });
    cluster.step(3);
    EXPECT_EQ(quality(), Quality::Good) << "2 ms old";
    cluster.step();
    EXPECT_EQ(quality(), Quality::Stale);
    EXPECT_FALSE(drive.lost) << "there is a present value";
    const Image image = cluster.cluster->image();
    EXPECT_EQ(image.nominalTime() - image.state(image.structure().find("/axis")).time, 3'000'000);
    cluster.step(2);
    EXPECT_EQ(quality(), Quality::Stale) << "5 ms old";
    EXPECT_TRUE(cluster.events().empty());
    cluster.step();
    EXPECT_EQ(quality(), Quality::Lost);

    onThread([](Line& line) { line.put({2, 2}); });
    cluster.step();
    EXPECT_EQ(quality(), Quality::Good);
}

class IoRequests : public IoExchange {
protected:
    // Begun in a hook.
    void ask() {
        drive.asks = true;
        cluster.step();
        EXPECT_TRUE(drive.wasBegun);
    }
    void expectRefused(const std::string& why) {
        stepUntil([this] { return !drive.asked.isRunning(); });
        EXPECT_EQ(drive.asked.failure(), "the device is away: " + why);
        EXPECT_EQ(done, 0);
    }

    std::atomic<int> done{0};

private:
    void SetUp() override {
        IoExchange::SetUp();
        drive.work = [this] { ++done; };
    }
};

TEST_F(IoRequests, AreDoneOnTheThreadOfTheDeviceWhereItSaysSo) {
    std::thread::id own, ofWork;
    drive.work = [&] {
        ++done;
        ofWork = std::this_thread::get_id();
    };
    start(obeying());
    onThread([&](Line& line) {
        own = std::this_thread::get_id();
        line.put({1, 1});
    });
    ask();
    onThread([](Line& line) { line.put({2, 2}); });
    cluster.step(10);
    EXPECT_TRUE(drive.asked.isRunning()) << "it is not lost, whatever else the thread does";
    drive.asks = true;
    cluster.step();
    EXPECT_FALSE(drive.wasBegun) << "it runs still";

    onThread([](Line& line) { line.doWork(); });
    EXPECT_FALSE(drive.asked.isRunning());
    EXPECT_EQ(drive.asked.failure(), "");
    EXPECT_EQ(done, 1);
    EXPECT_EQ(ofWork, own);
    onThread([](Line& line) { line.doWork(); });
    EXPECT_EQ(done, 1) << "once for each time that it is asked for";

    ask();
    onThread([](Line& line) { line.doWork(); });
    EXPECT_EQ(done, 2);
}

TEST_F(IoRequests, SayWhatTheWorkThrewAndDisturbNothingElse) {
    drive.work = [] { throw Error("parameter 6098h is read only"); };
    start(obeying());
    onThread([](Line& line) { line.put({1, 1}); });
    ask();
    onThread([](Line& line) { line.doWork(); });
    EXPECT_EQ(drive.asked.failure(), "parameter 6098h is read only");
    cluster.step();
    EXPECT_EQ(cluster.state("/drive"), State::Standby);
}

TEST_F(IoRequests, EndAsFailedWhileTheDeviceIsAway) {
    start(obeying());
    ask();
    onThread([](Line& line) { line.doWork(); });
    expectRefused("it has not answered yet");

    onThread([](Line& line) {
        line.put({1, 1});
        line.lose("the plug was pulled");
    });
    ask();
    onThread([](Line& line) { line.doWork(); });
    expectRefused("the plug was pulled");
}

TEST_F(IoRequests, EndAsFailedWhenTheThreadHasEndedAndUntilItAnswersAgain) {
    start(obeying());
    onThread([](Line& line) { line.put({1, 1}); });
    ask();
    onThread([](Line&) { throw Error("/dev/ttyS9: no such device"); });
    expectRefused("/dev/ttyS9: no such device");

    stepUntil([&] { return cluster.state("/drive") == State::Fault; });
    cluster.step();
    EXPECT_EQ(cluster.call("/drive", "clearFaults").outcome, Outcome::Done);
    stepUntil([&] { return drive.talks == 2; });
    ask();
    onThread([](Line& line) { line.doWork(); });
    expectRefused("it has not answered yet");
    onThread([](Line& line) { line.put({1, 1}); });
    ask();
    onThread([](Line& line) { line.doWork(); });
    EXPECT_EQ(done, 1);
}

}  // namespace

}  // namespace cortex::test
