// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "measure/measurement.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace cortex::profiler {

struct RunRequest {
    std::vector<std::string> names;  // of measurements; "all" or none: every one
    RunOptions options;
    std::filesystem::path folder;  // empty: profile-<UTC time>
    bool force = false;
    std::string command;  // as typed
};

// Exit code. Saves after each measurement; what there is when it is stopped is kept.
int runMeasurements(const RunRequest& request);

std::string measurementHelp();  // what can be asked for
std::vector<std::string> measurementNames();

// Makes the folder of a run. Throws Error where results would be lost.
std::filesystem::path makeFolder(const std::filesystem::path& wanted, bool force);
Results newResults(const std::string& command);
// Where the results are, after their summary; exit code.
int tellResults(const Results& results, const std::filesystem::path& folder);

}  // namespace cortex::profiler
