// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/realtime.hpp"

namespace cortex {

// Asks for the cache line at an address that is used soon; any address will do, also null.
// The empty statement is there for g++ 12, which drops calls of functions that do nothing else.
inline void fetch(const void* place) CORTEX_REALTIME {
    __builtin_prefetch(place);
    asm volatile("");
}

}  // namespace cortex
