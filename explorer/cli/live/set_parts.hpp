// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/program_interface.hpp"

#include <vector>

namespace cortex::cli {

// What one `set` would be too large for, as several in the order of names: each fits into the one
// datagram that a command has. An item that alone is too large is a part of its own.
std::vector<ProgramInterface::Arguments> setParts(const ProgramInterface::Arguments& items);

}  // namespace cortex::cli
