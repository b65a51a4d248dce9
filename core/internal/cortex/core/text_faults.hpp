// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/realtime.hpp"

#include <cstdint>
#include <string_view>

namespace cortex {

// Why others would not read this text as it is: "has the octet 0" or "is not UTF-8". Null: they
// would. The octet 0 ends a text on the wire.
const char* textFault(std::string_view text) CORTEX_REALTIME;

// How often a cell of any table has got a text with such a fault. Any thread.
std::uint64_t textFaults() CORTEX_REALTIME;

}  // namespace cortex
