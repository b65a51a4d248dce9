// SPDX-License-Identifier: Apache-2.0
// How old a device's value is after the loop, or all of the process, stood still. A wait makes it
// at least so old, whatever the machine does; nothing here has to be fast.
#include "cs/io_drive.hpp"
#include "support/stepped_clock.hpp"

#include <chrono>
#include <cstdint>
#include <thread>

#include <gtest/gtest.h>

namespace cortex::test {

namespace {

using namespace std::chrono_literals;
using Clock = cs::Pace::Clock;

constexpr std::chrono::nanoseconds pauseTime = 20ms;

class IoStandstill : public IoExchange {
protected:
    IoStandstill() { cluster.trigger = &clock.trigger; }
    void begin(std::chrono::nanoseconds lose) {
        drive.lose = lose;
        start(obeying());
        cluster.step();
    }
    // Of the process: neither a cycle nor nominal time goes by.
    static void standStill() { std::this_thread::sleep_for(pauseTime); }
    std::chrono::nanoseconds age() const { return std::chrono::nanoseconds{drive.ageSeen}; }
    std::int64_t stamp() {
        const Image image = cluster.cluster->image();
        return image.state(image.structure().find("/axis")).time;
    }

    SteppedClock& clock = cluster.cluster->setTriggerSource<SteppedClock>();
};

TEST_F(IoStandstill, LosesWhatWasPutBeforeItAndIsSeenForTheFirstTimeAfterIt) {
    begin(5ms);
    onThread([](Line& line) { line.put({1, 1}); });
    standStill();
    cluster.step();

    EXPECT_EQ(drive.seen.number, 1) << "it is new in this cycle";
    EXPECT_EQ(quality(), Quality::Lost);
    EXPECT_TRUE(drive.lost);
    EXPECT_GE(age(), pauseTime);
    cluster.step();
    EXPECT_TRUE(cluster.hasEvent("/drive: the device is lost: its newest value is 0."));
    EXPECT_TRUE(cluster.hasEvent(" s old, as the loop or thread io-drive stood still"));

    stepUntil([this] {
        onThread([](Line& line) { line.put({2, 2}); });
        cluster.step();
        return quality() == Quality::Good;
    });
    EXPECT_TRUE(cluster.hasEvent("/drive: the device is back"));
}

TEST_F(IoStandstill, AgesWhatWasSeenBeforeItAndItsStampNeverGoesBack) {
    begin(1h);
    onThread([](Line& line) { line.put({1, 1}); });
    cluster.step();
    const std::int64_t before = stamp();
    standStill();
    cluster.step();

    EXPECT_GE(age(), pauseTime);
    EXPECT_EQ(quality(), Quality::Good) << "it may be an hour old";
    EXPECT_GE(stamp(), before);
    const std::chrono::nanoseconds after = age();
    cluster.step(3);
    EXPECT_GE(age(), after) << "it falls only with a newer value";
}

TEST_F(IoStandstill, KnowsHowOldAValueIsThatTheThreadHandsOverLaterOn) {
    begin(1h);
    const auto asked = Clock::now();
    standStill();
    cluster.step(2);
    onThread([&](Line& line) { line.put({1, 1}, asked); });
    cluster.step();
    EXPECT_GE(age(), pauseTime);

    const auto put = Clock::now();
    onThread([](Line& line) { line.put({2, 2}); });
    cluster.step();
    EXPECT_EQ(drive.seen.number, 2);
    EXPECT_LE(age(), Clock::now() - put) << "what was put after it is as young as it is";
}

TEST_F(IoStandstill, OfTheThreadAloneIsSeenByWhatIsTooOldWhenItComes) {
    begin(5ms);
    onThread([](Line& line) { line.put({1, 1}, Clock::now() - 1h); });
    cluster.step();

    EXPECT_EQ(quality(), Quality::Lost);
    EXPECT_GE(age(), 1h);
}

}  // namespace

}  // namespace cortex::test
