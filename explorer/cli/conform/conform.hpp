// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "conform/bench.hpp"

#include <functional>

namespace cortex::cli::conform {

// Runs all tests that are for the device; what is moved or led elsewhere is put back after each of
// them. `each` gets every result as it comes. Throws Failure where nothing is seen of the device or
// control is refused, and Interrupted.
DeviceResults testDevice(Live& live, const Plant& plant, const Wishes& wishes,
                         const std::function<void(const Result&)>& each);

}  // namespace cortex::cli::conform
