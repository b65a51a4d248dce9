// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

// The registers of a Robotiq 2F-85, after the table in its instruction manual: what both sides of
// the wire know of them. Two octets in a register, the high one first. Functions may be called by
// any thread, allocate nothing and throw nothing.
namespace cortex::modbus {

struct RobotiqMap {
    static constexpr std::uint16_t request = 0x03E8, status = 0x07D0;
};
using RobotiqImage = std::array<std::uint16_t, 3>;  // of each of the two

// What is written.
struct RobotiqRequest {
    bool activate = false;  // rACT; 0 resets the gripper
    bool goTo = false;      // rGTO: moves to `position`
    bool release = false;   // rATR: opens slowly, for emergencies
    std::uint8_t position = 0, speed = 0, force = 0;

    bool operator==(const RobotiqRequest&) const = default;
};

enum class RobotiqActivation : std::uint8_t { Reset = 0, Activating = 1, Activated = 3 };
enum class RobotiqObject : std::uint8_t { Moving, StoppedOpening, StoppedClosing, AtDemand };

// What is read.
struct RobotiqStatus {
    bool active = false, goesTo = false;                       // gACT, gGTO: the bits as written
    RobotiqActivation activation = RobotiqActivation::Reset;   // gSTA
    RobotiqObject object = RobotiqObject::Moving;              // gOBJ
    std::uint8_t fault = 0;                                    // gFLT
    std::uint8_t positionEcho = 0, position = 0, current = 0;  // current: in 10 mA

    bool operator==(const RobotiqStatus&) const = default;
};

constexpr RobotiqImage encode(const RobotiqRequest& request) {
    const unsigned action = (request.activate ? 0x01U : 0U) | (request.goTo ? 0x08U : 0U) |
                            (request.release ? 0x10U : 0U);
    return {static_cast<std::uint16_t>(action << 8), request.position,
            static_cast<std::uint16_t>(request.speed << 8 | request.force)};
}

constexpr RobotiqRequest decodeRequest(const RobotiqImage& image) {
    const unsigned action = image[0] >> 8U;
    return {(action & 0x01U) != 0,
            (action & 0x08U) != 0,
            (action & 0x10U) != 0,
            static_cast<std::uint8_t>(image[1]),
            static_cast<std::uint8_t>(image[2] >> 8U),
            static_cast<std::uint8_t>(image[2])};
}

constexpr RobotiqImage encode(const RobotiqStatus& status) {
    const unsigned first = (status.active ? 0x01U : 0U) | (status.goesTo ? 0x08U : 0U) |
                           static_cast<unsigned>(status.activation) << 4U |
                           static_cast<unsigned>(status.object) << 6U;
    return {static_cast<std::uint16_t>(first << 8U),
            static_cast<std::uint16_t>((status.fault & 0xFU) << 8U | status.positionEcho),
            static_cast<std::uint16_t>(status.position << 8U | status.current)};
}

// Any contents mean something; activation may be 2, which has no name.
constexpr RobotiqStatus decodeStatus(const RobotiqImage& image) {
    const unsigned first = image[0] >> 8U;
    return {(first & 0x01U) != 0,
            (first & 0x08U) != 0,
            static_cast<RobotiqActivation>(first >> 4U & 3U),
            static_cast<RobotiqObject>(first >> 6U & 3U),
            static_cast<std::uint8_t>(image[1] >> 8U & 0xFU),
            static_cast<std::uint8_t>(image[1]),
            static_cast<std::uint8_t>(image[2] >> 8U),
            static_cast<std::uint8_t>(image[2])};
}

// Octets as numbers with units; a number beyond what an octet can say is the nearest that it can.
struct RobotiqScale {
    double stroke = 0.085;                                     // m, between wholly open and closed
    double open = 3, closed = 230;                             // octets of POSITION there
    static constexpr double slowest = 0.020, fastest = 0.150;  // m/s, of SPEED 0 and 255
    static constexpr double weakest = 20, strongest = 235;     // N, of FORCE 0 and 255

    double width(double octet) const { return stroke * (closed - octet) / (closed - open); }
    // 0 or less: 255, as closed as it goes; `stroke` or more: 0.
    std::uint8_t position(double width) const {
        if (width <= 0) return 255;
        if (width >= stroke) return 0;
        return octet(closed - width / stroke * (closed - open));
    }
    static std::uint8_t speed(double metresPerSecond) {
        return octet((metresPerSecond - slowest) / (fastest - slowest) * 255);
    }
    static std::uint8_t force(double newtons) {
        return octet((newtons - weakest) / (strongest - weakest) * 255);
    }
    static double speedOf(std::uint8_t octet) {
        return slowest + (fastest - slowest) * octet / 255;
    }
    static double forceOf(std::uint8_t octet) {
        return weakest + (strongest - weakest) * octet / 255;
    }

private:
    static std::uint8_t octet(double value) {  // what is no number is taken as 0
        return value >= 0 ? static_cast<std::uint8_t>(std::lround(std::min(value, 255.0))) : 0;
    }
};

}  // namespace cortex::modbus
