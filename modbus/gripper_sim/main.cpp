// SPDX-License-Identifier: Apache-2.0
// cortex-gripper-sim: a Robotiq 2F-85 behind Modbus/TCP that is a model. docs/gripper-simulator.md.
#include "gripper_sim/simulated_gripper.hpp"
#include "sim/program.hpp"

#include <memory>
#include <optional>
#include <utility>

#include <CLI/CLI.hpp>

namespace {

using namespace cortex::modbus::sim;

constexpr const char* programName = "cortex-gripper-sim";

constexpr const char* footerText =
    R"(It prints where it listens, and ends with SIGINT or SIGTERM. It speaks Modbus/TCP, function codes 3, 4,
6, 16 and 23, to up to 16 connections, one of which commands. Faults are commanded by registers.
Exit codes: 0 ended; 1 cannot listen; 2 usage.)";

int run(int argc, char** argv) {
    ServerOptions server;
    GripperSettings settings;
    CLI::App app{"Simulates a Robotiq 2F-85 behind Modbus/TCP.", programName};
    app.footer(footerText);
    addServerOptions(app, server, "each change of activation, object and fault");
    app.add_option("--object", settings.object,
                   "width of a work piece between the fingers in m; none if not given")
        ->type_name("WIDTH")
        ->check(aPositiveNumber)
        ->check(CLI::Range(0.001, 0.084));
    app.add_option("--activation-time", settings.activationTime,
                   "how long its activation takes in s; 2 if not given")
        ->type_name("S")
        ->check(aPositiveNumber)
        ->check(CLI::Range(0.01, 60.0));
    if (const std::optional<int> end = parse(app, argc, argv)) return *end;
    serve(programName, server, {}, [&](SimulatedDevice::Log log) {
        return std::make_unique<SimulatedGripper>(settings, std::move(log));
    });
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    return guarded(programName, [&] { return run(argc, argv); });
}
