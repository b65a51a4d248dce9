// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "conform/judgement.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace cortex::cli::conform {

// Results as JUnit XML, which build servers show: a test suite for each device. `began`: UTC ns.
std::string junitText(const std::vector<DeviceResults>& devices, std::int64_t began);

std::size_t count(const DeviceResults& device, Verdict verdict);

}  // namespace cortex::cli::conform
