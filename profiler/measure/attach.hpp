// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/network_options.hpp"

#include <filesystem>
#include <string>

namespace cortex::profiler {

struct AttachRequest {
    std::string agent;
    comms::NetworkOptions network;
    double seconds = 30;
    double timeout = 5;            // s to wait for the agent
    std::filesystem::path folder;  // empty: profile-<UTC time>
    bool force = false;
    std::string command;  // as typed
};

// Looks at the metrics that a running agent has as data. Exit code.
int attach(const AttachRequest& request);

}  // namespace cortex::profiler
