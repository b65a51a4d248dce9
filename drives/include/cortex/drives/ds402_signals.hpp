// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

// What goes to and fro between a CiA 402 drive and its master in each exchange, as plain data.
// Units are those of the axis: rad and N.m, or m and N.
namespace cortex::drives {

// What a master sends. A target that is no finite number leaves the last one, and raises bit 11.
struct Ds402Inputs {
    std::uint16_t controlWord = 0;     // 6040
    std::int8_t mode = 0;              // 6060; 0 asks for no change
    double position = 0;               // 607A: CyclicPosition, ProfilePosition
    double velocity = 0;               // 60FF: CyclicVelocity, ProfileVelocity
    double effort = 0;                 // 6071: CyclicTorque
    double velocityOffset = 0;         // 60B1: cyclic position and velocity
    double effortOffset = 0;           // 60B2: all cyclic modes
    std::uint32_t digitalOutputs = 0;  // 60FE; the lower 16 are wired to inputs 16 to 31

    template <class Archive>
    void keep(Archive& archive) {
        archive & controlWord & mode & position & velocity & effort;
        archive & velocityOffset & effortOffset & digitalOutputs;
    }
};

// What a master reads.
struct Ds402Outputs {
    std::uint16_t statusWord = 0;     // 6041
    std::int8_t modeDisplay = 0;      // 6061
    std::uint16_t errorCode = 0;      // 603F
    std::uint32_t digitalInputs = 0;  // 60FD: 0 negative limit, 1 positive limit, 2 home switch
    double position = 0;              // 6064, whole counts of the encoder
    double velocity = 0;              // 606C
    double effort = 0;                // 6077
    double demand = 0;                // 6062, position that the servo is led to
    double followingError = 0;        // 60F4, demand minus position; 0 in speed and torque modes
    double temperature = 25;          // of the power stage, Cel
    std::int32_t lastTransition = 0;  // its number
    std::uint32_t transitions = 0;    // how many there were
    std::uint32_t refused = 0;        // see Ds402Drive
    bool homed = false;

    template <class Archive>
    void keep(Archive& archive) {
        archive & statusWord & modeDisplay & errorCode & digitalInputs & position & velocity;
        archive & effort & demand & followingError & temperature & lastTransition & transitions;
        archive & refused & homed;
    }
};

}  // namespace cortex::drives
