// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/event.hpp"
#include "cortex/core/realtime.hpp"

#include <cstdint>

namespace cortex::toolkit {

// What is told of CiA 402 drives, as texts that a hook may make.

// As drives::errorName(): "following error (0x8611)".
EventText errorWords(std::int64_t code) CORTEX_REALTIME;
// "CSP", "mode 7".
EventText modeWords(std::int64_t mode) CORTEX_REALTIME;
// Number of the transition between two states that were seen one after the other. Where states
// between them were missed, of the last one.
int transitionBetween(int from, int to) CORTEX_REALTIME;

}  // namespace cortex::toolkit
