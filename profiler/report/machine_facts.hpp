// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace cortex::profiler {

inline constexpr const char* loadFact = "load average";  // differs between any two runs

// What measured times depend on, each fact with its value, "unknown" where the system does not
// tell. No names of hosts or users, no paths. `root` is where /proc and /sys are.
std::vector<std::pair<std::string, std::string>> machineFacts(
    const std::filesystem::path& root = "/");

}  // namespace cortex::profiler
