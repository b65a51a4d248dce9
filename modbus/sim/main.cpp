// SPDX-License-Identifier: Apache-2.0
// cortex-ds402-sim: a CiA 402 drive behind Modbus/TCP that is a model. docs/ds402-simulator.md.
#include "sim/options.hpp"

#include <memory>
#include <utility>

namespace {

using namespace cortex::modbus::sim;

int run(int argc, char** argv) {
    int exitCode = 0;
    const auto line = parseCommandLine(argc, argv, exitCode);
    if (!line) return exitCode;
    serve(programName, line->server, line->longestPause, [&](SimulatedDevice::Log log) {
        return std::make_unique<SimulatedDrive>(line->drive, std::move(log));
    });
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    return guarded(programName, [&] { return run(argc, argv); });
}
