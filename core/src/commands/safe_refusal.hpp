// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/event.hpp"
#include "cortex/core/tables.hpp"

#include <cstdint>
#include <optional>

namespace cortex {

// Why what `set` writes to an item of a demand would not go out: in each cycle its safe value is
// written over it, or what one of several writers writes. None: it goes out. Before tasks, so as
// the cycle before has left it.
std::optional<EventText> safeRefusal(const Structure& structure, const Tables& tables,
                                     std::uint32_t simplex, const DataItem& item) CORTEX_REALTIME;

}  // namespace cortex
