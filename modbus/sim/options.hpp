// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/program.hpp"
#include "sim/simulated_drive.hpp"

#include <chrono>
#include <optional>

namespace cortex::modbus::sim {

inline constexpr const char* programName = "cortex-ds402-sim";

struct CommandLine {
    ServerOptions server;
    DriveSettings drive;
    std::chrono::milliseconds longestPause{50};
};

// None: `exitCode` says how the program ends, and what there was to say is printed.
std::optional<CommandLine> parseCommandLine(int argc, char** argv, int& exitCode);

}  // namespace cortex::modbus::sim
