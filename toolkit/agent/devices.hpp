// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/simplex_tree.hpp"

#include <string>
#include <vector>

namespace cortex::toolkit {

// A device outside of this process: of a type that extends FieldbusDevice, with a thread of its
// own.
struct TalkedTo {
    std::string path;  // of its simplex
    std::string name;  // "127.0.0.1:502, unit 1": one device, however its address is written
};
std::vector<TalkedTo> devicesOf(const SimplexTree& tree);

// "devices: /coupler at 127.0.0.1:502, unit 1; /drive at …", a line; "" where there is none.
// `talks`: otherwise it says that nobody talks to them, and that nothing is kept.
std::string devicesLine(const std::vector<TalkedTo>& devices, bool talks);

}  // namespace cortex::toolkit
