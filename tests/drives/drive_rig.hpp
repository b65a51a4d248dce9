// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/drives/ds402_drive.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cortex::drives::test {

// A drive that is stepped each millisecond with inputs that stay until they are changed.
struct DriveRig {
    explicit DriveRig(const Ds402Parameters& parameters = {}, const Ds402Axis& axis = quickAxis())
        : drive{axis, parameters} {}

    static Ds402Axis quickAxis() {
        Ds402Axis axis;
        axis.negativeSwitch = -3;
        axis.positiveSwitch = 3;
        axis.indexDistance = 0.06;
        return axis;
    }

    void run(double seconds) {
        for (long left = std::lround(seconds * 1000); left > 0; --left) drive.step(in, 1e-3);
    }
    void send(std::uint16_t word, double seconds = 2e-3) {
        in.controlWord = word;
        run(seconds);
    }
    // From power on to Operation enabled, with the brake open.
    void enable(Ds402Mode mode) {
        in.mode = static_cast<std::int8_t>(mode);
        in.position = drive.outputs().position;
        run(0.6);
        send(0x0006);
        send(0x000F, 0.05);
        ASSERT_EQ(drive.state(), Ds402State::OperationEnabled);
    }
    // Enabled, and turning at this speed.
    void turn(double velocity) {
        enable(Ds402Mode::CyclicVelocity);
        in.velocity = velocity;
        run(0.5);
        ASSERT_NEAR(drive.outputs().velocity, velocity, 1e-3);
    }
    // Until the state is left, at most so many seconds; how long it took.
    double untilNot(Ds402State state, double most) {
        double taken = 0;
        for (; drive.state() == state && taken < most; taken += 1e-3) run(1e-3);
        return taken;
    }
    bool bit(std::uint16_t mask) const { return (out().statusWord & mask) != 0; }
    const Ds402Outputs& out() const { return drive.outputs(); }

    Ds402Drive drive;
    Ds402Inputs in;
};

}  // namespace cortex::drives::test
