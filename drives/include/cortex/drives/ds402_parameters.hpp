// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/drives/ds402_words.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

// What a drive model is set to. Units are those of the axis: rad and N.m, or m and N; times are s.
// Numbers in comments are objects of CiA 402. All is plain data.
namespace cortex::drives {

// What a master may write. Chosen defaults; nobody publishes any.
struct Ds402Parameters {
    std::int32_t quickStopOption = 2;                // 605A
    std::int32_t shutdownOption = 1;                 // 605B
    std::int32_t disableOption = 1;                  // 605C
    std::int32_t haltOption = 1;                     // 605D
    std::int32_t faultReactionOption = 2;            // 605E
    std::int32_t abortOption = 1;                    // 6007
    std::int32_t homingMethod = 37;                  // 6098
    std::uint32_t supportedModes = ds402BuiltModes;  // 6502
    double followingErrorWindow = 0.1;               // 6065; 0: not watched
    double followingErrorTime = 0.05;                // 6066
    double ratedEffort = 10;                         // 6076
    double homeOffset = 0;              // 607C, position of the place that homing finds
    double softMin = 0;                 // 607D:1; both 0: no limits
    double softMax = 0;                 // 607D:2
    double maxVelocity = 10;            // 607F, in every mode
    double profileVelocity = 0.5;       // 6081
    double profileAcceleration = 2;     // 6083, and of the slow ramp
    double quickStopDeceleration = 10;  // 6085, the quick ramp
    double countsPerUnit = 100000;      // 608F, gears included
    double homingSpeed = 0.2;           // 6099:1, towards a switch
    double homingCreep = 0.02;          // 6099:2, towards an edge or the index
    double homingAcceleration = 2;      // 609A

    template <class Archive>
    void keep(Archive& archive) {
        archive & quickStopOption & shutdownOption & disableOption & haltOption;
        archive & faultReactionOption & abortOption & homingMethod & supportedModes;
        archive & followingErrorWindow & followingErrorTime & ratedEffort & homeOffset;
        archive & softMin & softMax & maxVelocity & profileVelocity & profileAcceleration;
        archive & quickStopDeceleration & countsPerUnit & homingSpeed & homingCreep;
        archive & homingAcceleration;
    }
};

struct Ds402OptionRow {
    std::uint16_t object;
    std::int32_t min, max;  // values that the model and the processor know
    std::string_view name;
    std::string_view values;
};

inline constexpr std::array<Ds402OptionRow, 6> ds402Options{{
    {0x605A, 0, 8, "quick stop option",
     "0 power off, 1 slow ramp, 2 to 4 quick ramp, 5 slow ramp and stay, 6 to 8 quick ramp and "
     "stay"},
    {0x605B, 0, 1, "shutdown option", "0 power off, 1 slow ramp"},
    {0x605C, 0, 1, "disable operation option", "0 torque off, 1 slow ramp"},
    {0x605D, 1, 2, "halt option", "1 slow ramp, 2 quick ramp"},
    {0x605E, 0, 2, "fault reaction option", "0 power off, 1 slow ramp, 2 quick ramp"},
    {0x6007, 0, 3, "option for a lost connection",
     "0 nothing, 1 fault, 2 disable voltage, 3 quick stop"},
}};

// False also for objects that are no option.
constexpr bool isOption(std::uint16_t object, std::int64_t value) noexcept {
    for (const Ds402OptionRow& row : ds402Options)
        if (row.object == object) return value >= row.min && value <= row.max;
    return false;
}

// Whether a drive can be set to them. In a tick.
bool isValid(const Ds402Parameters& parameters) noexcept;
// The first that is wrong, as a sentence with the remedy; empty where none is. Not in a tick.
std::string whyNot(const Ds402Parameters& parameters);

// Homing methods (6098) that the model knows: 1, 2, 17, 18, 33, 34, 35, 37. Others end in an error.
bool isHomingMethod(int method) noexcept;

// The axis behind the drive: what nobody can write over a bus.
struct Ds402Axis {
    static constexpr double nowhere = std::numeric_limits<double>::infinity();

    double inertia = 0.1;              // kg.m2 or kg; above 0
    double damping = 0;                // N.m.s or N.s/m
    double effortShare = 3;            // greatest effort, as a share of the rated one
    double brakeTime = 0.03;           // to close and to open
    double selfTestTime = 0.5;         // in Not ready to switch on
    double startPosition = 0;          // of the mechanism
    double negativeSwitch = -nowhere;  // on at and below this place
    double positiveSwitch = nowhere;   // on at and above this place
    double homeSwitch = nowhere;       // on at and above this place; no homing method uses it
    double overtravel = 0.1;           // from a limit switch to the stop behind it
    double indexDistance = 0;          // from one index to the next, with one at 0; 0: no index
    bool absoluteEncoder = false;      // it needs no homing
};

bool isValid(const Ds402Axis& axis) noexcept;

// What goes wrong on command. It may be changed between two steps at any time.
struct Ds402Disturbance {
    double load = 0;             // effort that pulls towards the negative side
    double friction = 0;         // dry: effort against the motion, or that it takes to begin one
    std::uint32_t stuckOn = 0;   // bits of the digital inputs that stay 1
    std::uint32_t stuckOff = 0;  // that stay 0
    bool blockedRotor = false;
    // Least and greatest place that something hard allows; both 0: none. It takes all speed from
    // the axis, and never moves it: one that is beyond can only come back.
    double stopMin = 0, stopMax = 0;

    template <class Archive>
    void keep(Archive& archive) {
        archive & load & friction & stuckOn & stuckOff & blockedRotor & stopMin & stopMax;
    }
};

}  // namespace cortex::drives
