// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/command.hpp"

#include <cstddef>

namespace cortex {

// A parameter without a default has no value that a sender could have meant by saying nothing. So a
// sender's record begins with values that nobody writes, and is looked at until none is left.

// False: there is no such parameter.
bool markUnset(const CommandTable::Entry& entry, std::byte* request);
// The first that was never set, or null; the rest of an array of which an element was set gets its
// usual values.
const DataItem* findUnset(const CommandTable::Entry& entry, std::byte* request) CORTEX_REALTIME;

}  // namespace cortex
