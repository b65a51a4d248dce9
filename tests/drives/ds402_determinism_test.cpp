// SPDX-License-Identifier: Apache-2.0
#include "drives/drive_rig.hpp"

#include <array>
#include <cstring>
#include <limits>
#include <random>
#include <set>
#include <vector>

namespace cortex::drives::test {
namespace {

using enum Ds402State;

// All that a drive keeps, as bits.
struct Bits {
    template <class T>
    Bits& operator&(T& value) {
        if constexpr (requires { value.keep(*this); }) {
            value.keep(*this);
        } else {
            const std::size_t from = bytes.size();
            bytes.resize(from + sizeof(T));
            std::memcpy(bytes.data() + from, &value, sizeof(T));
        }
        return *this;
    }
    std::vector<std::byte> bytes;
};

std::vector<std::byte> bits(Ds402Drive drive) {
    Bits all;
    drive.keep(all);
    return all.bytes;
}

TEST(Ds402Drive, DoesNothingForATimeThatIsNone) {
    DriveRig rig;
    const auto before = bits(rig.drive);
    for (const double seconds : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
        rig.drive.step(rig.in, seconds);

    EXPECT_EQ(bits(rig.drive), before);
    rig.drive.step(rig.in, std::numeric_limits<double>::infinity());
    EXPECT_EQ(rig.drive.state(), SwitchOnDisabled) << "what is too long is cut";
}

// A busy hour of words, modes and targets, the same for each drive that it is given.
class Weather {
public:
    Ds402Inputs next() {
        if (step_ % 7 == 0) in_.controlWord = word();
        if (step_ % 50 == 0) in_.mode = static_cast<std::int8_t>(in(-2, 11));
        in_.position = in(-40, 40) / 10.0;
        in_.velocity = in(-20, 20) / 10.0;
        in_.effort = in(-300, 300) / 10.0;
        in_.velocityOffset = in(-10, 10) / 10.0;
        if (step_ % 91 == 0) in_.position = std::numeric_limits<double>::quiet_NaN();
        ++step_;
        return in_;
    }
    void disturb(Ds402Drive& drive) {
        if (in(0, 499) == 0) drive.fail(static_cast<std::uint16_t>(in(0, 0xFFFF)), in(0, 1) == 1);
        if (in(0, 299) == 0) drive.clearCause();
        if (in(0, 999) == 0) drive.jumpEncoder(in(-10, 10) / 10.0);
        if (in(0, 999) == 0) drive.communicationLost();
        if (in(0, 4999) == 0) drive.powerCycle();
        if (in(0, 199) == 0) drive.disturbance.load = in(-40, 40);
        if (in(0, 499) == 0) drive.disturbance.blockedRotor = in(0, 2) == 0;
        if (in(0, 499) == 0) drive.disturbance.stopMin = in(-30, 0) / 10.0;
        if (in(0, 499) == 0) drive.disturbance.stopMax = in(-1, 30) / 10.0;
        if (in(0, 499) == 0) drive.disturbance.stuckOn = static_cast<std::uint32_t>(in(0, 7));
        Ds402Parameters parameters = drive.parameters();
        parameters.quickStopOption = in(0, 8);
        parameters.homingMethod = in(0, 40);
        if (in(0, 99) == 0) drive.set(parameters);
    }

private:
    int in(int least, int most) { return std::uniform_int_distribution{least, most}(random_); }
    std::uint16_t word() {
        constexpr std::array<std::uint16_t, 8> usual{6, 7, 15, 15, 0x1F, 2, 0, 0x80};
        return in(0, 3) ? usual[static_cast<std::size_t>(in(0, 7))]
                        : static_cast<std::uint16_t>(in(0, 0xFFFF));
    }
    std::mt19937 random_{42};
    Ds402Inputs in_;
    long step_ = 0;
};

bool isOfTheTable(int number, Ds402State from, Ds402State to) {
    for (const Ds402Transition& row : ds402Transitions)
        if (row.number == number && row.to == to && (row.from == from || row.from == Unknown))
            return true;
    return false;
}

TEST(Ds402Drive, NeverLeavesItsTableIn100000StepsOfRandomWords) {
    Ds402Axis axis = DriveRig::quickAxis();
    axis.selfTestTime = 0.01;
    DriveRig rig{{}, axis};
    Weather weather;
    std::set<int> seen;
    for (int i = 0; i < 100000; ++i) {
        const Ds402State before = rig.drive.state();
        const std::uint32_t count = rig.out().transitions;
        weather.disturb(rig.drive);
        const Ds402State disturbed = rig.drive.state();
        rig.drive.step(weather.next(), Ds402Drive::timeStep);
        const std::uint32_t made = rig.out().transitions - count;
        ASSERT_EQ(stateOf(rig.out().statusWord), rig.drive.state());
        ASSERT_TRUE(std::isfinite(rig.out().position) && std::isfinite(rig.out().effort)) << i;
        if (made == 0) ASSERT_EQ(rig.drive.state(), before);
        if (made == 1 && disturbed == before)
            ASSERT_TRUE(isOfTheTable(rig.out().lastTransition, before, rig.drive.state()))
                << rig.out().lastTransition << " in " << nameOf(before);
        seen.insert(rig.out().lastTransition);
    }
    for (int number = 0; number < ds402TransitionNumbers; ++number)
        if (number != 0) EXPECT_TRUE(seen.contains(number)) << number;
}

TEST(Ds402Drive, IsTheSameBitForBitInTwoRunsAndAfterItWasRestored) {
    DriveRig one, two, restored;
    Weather first, second;
    for (int i = 0; i < 20000; ++i) {
        first.disturb(one.drive);
        one.drive.step(first.next(), 3.3e-4);
        second.disturb(two.drive);
        two.drive.step(second.next(), 3.3e-4);
        if (i == 9999) restored.drive = two.drive;
    }
    EXPECT_EQ(bits(one.drive), bits(two.drive));

    Weather third;
    Ds402Drive dummy;
    for (int i = 0; i < 10000; ++i) {
        third.disturb(dummy);
        third.next();
    }
    for (int i = 0; i < 10000; ++i) {
        third.disturb(restored.drive);
        restored.drive.step(third.next(), 3.3e-4);
    }
    EXPECT_EQ(bits(restored.drive), bits(one.drive));
}

// What keep() writes into another drive of the same axis makes it go on as the first.
struct Write {
    template <class T>
    Write& operator&(T& value) {
        if constexpr (requires { value.keep(*this); }) {
            value.keep(*this);
        } else {
            std::memcpy(&value, bytes.data() + at, sizeof(T));
            at += sizeof(T);
        }
        return *this;
    }
    std::vector<std::byte> bytes;
    std::size_t at = 0;
};

TEST(Ds402Drive, GoesOnBitForBitFromWhatItKept) {
    DriveRig one, two;
    Weather weather;
    for (int i = 0; i < 5000; ++i) {
        weather.disturb(one.drive);
        one.drive.step(weather.next(), 1e-3);
    }
    Write restore{bits(one.drive)};
    two.drive.keep(restore);
    Weather same = weather;
    for (int i = 0; i < 5000; ++i) {
        weather.disturb(one.drive);
        one.drive.step(weather.next(), 1e-3);
        same.disturb(two.drive);
        two.drive.step(same.next(), 1e-3);
    }

    EXPECT_EQ(bits(one.drive), bits(two.drive));
}

TEST(Ds402Drive, KeepsThatAWordHasHadItsEffect) {
    Ds402Parameters parameters;
    parameters.abortOption = 3;
    parameters.quickStopOption = 6;
    DriveRig one{parameters}, two;
    one.turn(1);
    one.drive.communicationLost();
    one.run(0.5);
    Write restore{bits(one.drive)};
    two.drive.keep(restore);
    two.in = one.in;
    two.run(0.5);

    EXPECT_EQ(two.drive.state(), QuickStopActive) << "000F still stands";
}

}  // namespace
}  // namespace cortex::drives::test
