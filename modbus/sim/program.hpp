// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/simulated_device.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace CLI {
class App;
}

// What the programs that simulate a device have in common: options, signals, the way out.
namespace cortex::modbus::sim {

inline constexpr int usageError = 2;

struct ServerOptions {
    std::string address = "127.0.0.1";
    std::uint16_t port = 0;
    bool log = false;
};

// --version, --port, --address and --log; `logged` says what the log has.
void addServerOptions(CLI::App& app, ServerOptions& options, const std::string& logged);
// For CLI11: why this text is no number from 1e-6 to 1e9; "": it is one.
std::string aPositiveNumber(const std::string& text);
// The exit code where the program ends here; what there was to say is printed.
std::optional<int> parse(CLI::App& app, int argc, char** argv);

// Prints where it listens, makes the device, and serves it until SIGINT or SIGTERM. `longestPause`:
// as Server has it. Throws std::runtime_error where it cannot listen.
using MakeDevice = std::function<std::unique_ptr<SimulatedDevice>(SimulatedDevice::Log log)>;
void serve(const std::string& program, const ServerOptions& options,
           std::chrono::nanoseconds longestPause, const MakeDevice& make);

// The exit code of main(): that of `run`, or 1 with what it throws on the standard error.
int guarded(const std::string& program, const std::function<int()>& run);

}  // namespace cortex::modbus::sim
