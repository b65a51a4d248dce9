// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace cortex::comms {

using Moment = std::chrono::steady_clock::time_point;  // of the same clock as monotonicNow()

}  // namespace cortex::comms
