// SPDX-License-Identifier: Apache-2.0
// The simulated drive by its registers, in its own time and without a socket.
#include "cortex/drives/ds402_state.hpp"

#include "sim/simulated_drive.hpp"

#include <chrono>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::modbus::test {
namespace {

using namespace std::chrono_literals;
using drives::Ds402State;
using sim::AxisFaults;
using sim::Exception;

using Numbers = std::vector<std::uint16_t>;

class RegistersOfSim : public testing::Test {
protected:
    RegistersOfSim() { drive.step(510ms); }  // its self test

    Numbers read(std::uint16_t first, std::size_t count) {
        Numbers words(count);
        EXPECT_EQ(drive.read(first, words), Exception::None) << first;
        return words;
    }
    std::uint16_t one(std::uint16_t at) { return read(at, 1).front(); }
    Exception write(std::uint16_t first, const Numbers& words) { return drive.write(first, words); }
    void set(std::uint16_t first, const Numbers& words) {
        EXPECT_EQ(write(first, words), Exception::None) << first;
    }
    Exception writeParameter(std::size_t row, std::int32_t value) {
        Numbers words(2);
        split(static_cast<std::uint32_t>(value), WordOrder::HighWordFirst,
              std::span<std::uint16_t, 2>{words});
        return write(static_cast<std::uint16_t>(0x1000 + 2 * row), words);
    }
    Ds402AxisSeen seen(std::size_t axis = 0) {
        Ds402SeeImage image{};
        EXPECT_EQ(drive.read(Ds402Map::read, image), Exception::None);
        return decode(image, WordOrder::HighWordFirst).axes[axis];
    }
    Ds402State state(std::size_t axis = 0) { return drives::stateOf(seen(axis).statusWord); }
    void say(std::uint16_t word) {
        set(0, {word});
        drive.exchanged();
        drive.step(1ms);
    }
    void enable() {
        for (const std::uint16_t word : Numbers{6, 7, 15}) say(word);
        EXPECT_EQ(state(), Ds402State::OperationEnabled);
    }

    std::vector<std::string> log;
    sim::SimulatedDrive drive{{.axes = 2},
                              [this](const std::string& line) { log.push_back(line); }};
};

TEST_F(RegistersOfSim, TellWhoItIs) {
    EXPECT_EQ(read(0x3000, 4), (Numbers{0x4358, 0x3032, 2, 0}));
    EXPECT_EQ(one(0x0133), 2);
    EXPECT_EQ(one(0x0100) & 0x4F, 0x40) << "Switch on disabled";
}

TEST_F(RegistersOfSim, HaveNoPlaceForOtherAddresses) {
    Numbers words(2);
    for (const int first : {0x0022, 0x00FF, 0x0133, 0x0134, 0x102B, 0x1200, 0x2002, 0x300D, 0xF00D,
                            0xF020, 0xF106, 0xFFFE}) {
        const auto at = static_cast<std::uint16_t>(first);
        EXPECT_EQ(drive.read(at, words), Exception::Address) << first;
        EXPECT_EQ(write(at, words), Exception::Address) << first;
    }
    for (const int first : {0x0100, 0x2001, 0x3000})
        EXPECT_EQ(write(static_cast<std::uint16_t>(first), {0}), Exception::Address) << "only read";
}

TEST_F(RegistersOfSim, TakeNumbersAsAWholeOnly) {
    set(0x0000, {6, 8, 0x0001, 0x86A0});
    EXPECT_EQ(write(0x0003, {1}), Exception::Value);
    EXPECT_EQ(write(0x0000, {6, 8, 1}), Exception::Value);
    EXPECT_EQ(write(0x1001, {1}), Exception::Value);
    EXPECT_EQ(write(0x1000, {0}), Exception::Value);
    EXPECT_EQ(write(0xF002, {1}), Exception::Value);
    EXPECT_EQ(read(0x0000, 4), (Numbers{6, 8, 0x0001, 0x86A0}));
}

TEST_F(RegistersOfSim, ReadParametersBackAndRefuseWhatCannotBe) {
    EXPECT_EQ(writeParameter(0, 5), Exception::None);
    EXPECT_EQ(read(0x1000, 2), (Numbers{0, 5}));
    EXPECT_EQ(writeParameter(0, 9), Exception::Value) << "605A knows 0 to 8";
    EXPECT_EQ(writeParameter(3, 0), Exception::Value) << "605D knows 1 and 2";
    EXPECT_EQ(writeParameter(13, -1), Exception::Value) << "a velocity";
    EXPECT_EQ(writeParameter(8, 1), Exception::Value) << "6076 is fixed";
    EXPECT_EQ(writeParameter(8, 10000), Exception::None) << "but it may be written as it is";
    EXPECT_EQ(writeParameter(17, 128), Exception::Value) << "a homing method has 8 bits";
    EXPECT_EQ(writeParameter(17, -5), Exception::None);
    EXPECT_EQ(read(0x1022, 2), (Numbers{0xFFFF, 0xFFFB}));
    EXPECT_EQ(read(0x1000, 2), (Numbers{0, 5})) << "as it was";
    EXPECT_EQ(read(0x1100, 2), (Numbers{0, 2})) << "the other axis";
}

TEST_F(RegistersOfSim, WriteAllParametersOrNone) {
    const Numbers before = read(0x1000, 12);
    EXPECT_EQ(write(0x1000, {0, 6, 0, 0, 0, 0, 0, 7}), Exception::Value);
    EXPECT_EQ(read(0x1000, 12), before);
}

TEST_F(RegistersOfSim, LetTheWatchdogActOnTheMillisecondAndOnce) {
    enable();
    drive.exchanged();
    drive.step(100ms);
    EXPECT_EQ(state(), Ds402State::OperationEnabled);
    drive.step(200us);
    EXPECT_EQ(state(), Ds402State::FaultReactionActive);
    drive.step(500ms);
    EXPECT_EQ(state(), Ds402State::Fault);
    EXPECT_EQ(seen().errorCode, 0x7500);
    EXPECT_EQ(state(1), Ds402State::SwitchOnDisabled) << "it was not enabled";
    EXPECT_EQ(one(0x2001), 1);
}

TEST_F(RegistersOfSim, DoWhatTheOptionSaysWhenNobodySpeaks) {
    EXPECT_EQ(writeParameter(5, 3), Exception::None);  // 6007: quick stop
    EXPECT_EQ(writeParameter(0, 6), Exception::None);  // which stays
    enable();
    drive.step(101ms);
    EXPECT_EQ(state(), Ds402State::QuickStopActive);
    EXPECT_EQ(seen().errorCode, 0);
}

TEST_F(RegistersOfSim, TripAtOnceWhenWhoCommandsLeavesAndForNothingWhileNobodyIsEnabled) {
    set(0x2000, {0});  // no watchdog
    drive.disconnected();
    EXPECT_EQ(one(0x2001), 0);
    enable();
    drive.step(10s);
    EXPECT_EQ(state(), Ds402State::OperationEnabled);
    drive.disconnected();
    drive.step(200us);
    EXPECT_EQ(state(), Ds402State::FaultReactionActive);
    EXPECT_EQ(one(0x2001), 1);
}

TEST_F(RegistersOfSim, BoundTheWatchdog) {
    for (const std::uint16_t wrong : Numbers{1, 9, 5001, 65535})
        EXPECT_EQ(write(0x2000, {wrong}), Exception::Value) << wrong;
    for (const std::uint16_t right : Numbers{0, 10, 5000}) set(0x2000, {right});
    EXPECT_EQ(one(0x2000), 5000);
}

TEST_F(RegistersOfSim, TakeAPauseOfTheProcessForAFaultAndNotForALeap) {
    enable();
    set(0x0001, {9});
    set(0x0004, {0, 10000});  // 0.1 rad/s
    for (int i = 0; i < 200; ++i) say(15);
    const std::int32_t place = seen().position;
    EXPECT_GT(place, 0);

    drive.stoodStill(10s);

    EXPECT_EQ(seen().position, place);
    drive.step(500ms);
    EXPECT_EQ(state(), Ds402State::Fault);
    EXPECT_EQ(seen().errorCode, 0x7500);
    EXPECT_LT(seen().position, place + 2000) << "it braked";
}

TEST_F(RegistersOfSim, RaiseFaultsOnCommand) {
    enable();
    set(0xF000, {0x3210});
    drive.step(500ms);
    EXPECT_EQ(state(), Ds402State::Fault);
    EXPECT_EQ(seen().errorCode, 0x3210);
    EXPECT_EQ(one(0xF000), 0) << "it happens once";
    say(0x80);
    EXPECT_EQ(state(), Ds402State::SwitchOnDisabled);

    set(0xF001, {0x4310});
    drive.step(500ms);
    say(0);
    say(0x80);
    EXPECT_EQ(state(), Ds402State::Fault) << "its cause stands";
    set(0xF001, {0});
    say(0);
    say(0x80);
    EXPECT_EQ(state(), Ds402State::SwitchOnDisabled);
}

TEST_F(RegistersOfSim, DisturbTheMechanismOnCommand) {
    const auto blockedBy = [this](const Numbers& place, const Numbers& value) {
        enable();
        set(place.front(), value);
        set(0x0001, {8});
        set(0x0002, {0x0001, 0x86A0});  // 1 rad, at once
        for (int i = 0; i < 300; ++i) say(15);
        EXPECT_EQ(state(), Ds402State::Fault);
        EXPECT_EQ(seen().errorCode, 0x8611) << "following error";
        set(place.front(), Numbers(value.size()));
        set(0x0002, {0, 0});
        say(0);
        say(0x80);
    };
    blockedBy({0xF006}, {1});               // rotor
    blockedBy({0xF004}, {0x000F, 0x4240});  // friction, 1000 N.m
    blockedBy({0xF002}, {0x0001, 0x86A0});  // load, 100 N.m
}

TEST_F(RegistersOfSim, StickASwitchJumpAnEncoderAndSwitchOffAndOn) {
    set(0xF007, {2});
    drive.step(1ms);
    EXPECT_EQ(seen().inputs & 7, 2U);
    set(0xF007, {0});
    const std::int32_t before = seen().position;
    set(0xF00A, {0xFFFF, 0xFC18});
    drive.step(1ms);
    EXPECT_EQ(seen().position, before - 1000);
    EXPECT_EQ(read(0xF00A, 2), (Numbers{0, 0}));
    enable();
    set(0xF00C, {1});
    EXPECT_EQ(state(), Ds402State::NotReadyToSwitchOn);
    EXPECT_EQ(seen().lastTransition, 0);
    EXPECT_EQ(write(0xF006, {2}), Exception::Value);
    EXPECT_EQ(write(0xF007, {8}), Exception::Value);
    EXPECT_EQ(write(0xF100, {60001}), Exception::Value);
    EXPECT_EQ(write(0xF102, {7}), Exception::Value);
}

TEST_F(RegistersOfSim, LogTransitionsRefusedWordsAndTrips) {
    log.clear();
    say(15);
    say(6);
    ASSERT_EQ(log.size(), 2U);
    EXPECT_NE(log[0].find("s axis 1: refused word 000F, mode 0 in Switch on disabled"),
              std::string::npos)
        << log[0];
    EXPECT_NE(log[1].find("s axis 1: transition 2, Switch on disabled -> Ready to switch on"),
              std::string::npos)
        << log[1];
    enable();
    drive.step(101ms);
    EXPECT_NE(log.back().find("transition 13"), std::string::npos) << log.back();
    EXPECT_NE(log[log.size() - 2].find("watchdog: no FC 23 for 100 ms"), std::string::npos);
}

TEST_F(RegistersOfSim, StandAnyWritesAtAnyPlace) {
    std::mt19937 random{402};
    const std::uint16_t bases[] = {0x0000, 0x0010, 0x0100, 0x1000, 0x1100,
                                   0x2000, 0x3000, 0xF000, 0xF010, 0xF100};
    for (int i = 0; i < 3000; ++i) {
        Numbers words(1 + random() % 40);
        for (std::uint16_t& each : words) each = static_cast<std::uint16_t>(random());
        const auto first = static_cast<std::uint16_t>(bases[random() % 10] + random() % 20);
        write(first, words);
        drive.read(first, words);
        drive.step(200us);
    }
    const Ds402AxisSeen now = seen();
    EXPECT_NE(drives::stateOf(now.statusWord), Ds402State::Unknown);
}

}  // namespace
}  // namespace cortex::modbus::test
