// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/realtime.hpp"

namespace cortex {

// Asks for the cache line at an address that is used soon; any address will do, also null.
// Always inlined: g++ 12 drops calls of functions that do nothing else.
[[gnu::always_inline]] inline void fetch(const void* place) CORTEX_REALTIME {
    __builtin_prefetch(place);
}

}  // namespace cortex
