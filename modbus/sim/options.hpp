// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/simulated_drive.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace cortex::modbus::sim {

struct CommandLine {
    std::string address = "127.0.0.1";
    std::uint16_t port = 0;
    DriveSettings drive;
    std::chrono::milliseconds longestPause{50};
    bool log = false;
};

// None: `exitCode` says how the program ends, and what there was to say is printed.
std::optional<CommandLine> parseCommandLine(int argc, char** argv, int& exitCode);

}  // namespace cortex::modbus::sim
