// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace cortex::modbus {

// What gFLT means, after the instruction manual of the 2F-85.
struct RobotiqFault {
    std::uint8_t code;
    bool stops;       // the gripper obeys nobody, and a person has to look at it
    bool needsReset;  // only an activation ends it
    const char* words;
};

inline constexpr std::array robotiqFaults{
    RobotiqFault{0x5, false, false, "it moves only when its activation has ended"},
    RobotiqFault{0x7, false, false, "it moves only when it is activated"},
    RobotiqFault{0x8, true, false, "it is too hot; let it cool down"},
    RobotiqFault{0x9, false, false, "it heard nobody for a second"},
    RobotiqFault{0xA, true, true, "its voltage is too low; look at its supply"},
    RobotiqFault{0xB, true, true, "it releases what it holds on its own"},
    RobotiqFault{0xC, true, true, "an internal fault; ask its maker"},
    RobotiqFault{0xD, true, true,
                 "its activation has failed; take away what is in the way of its fingers"},
    RobotiqFault{0xE, true, true, "its current was too high; look for what blocks its fingers"},
    RobotiqFault{0xF, true, true, "it has released what it held on its own"},
};

// Of a code other than 0.
constexpr RobotiqFault robotiqFault(std::uint8_t code) {
    const auto* row = std::ranges::find(robotiqFaults, code, &RobotiqFault::code);
    if (row != robotiqFaults.end()) return *row;
    return {code, true, true, "a code that its manual does not name; ask its maker"};
}

}  // namespace cortex::modbus
