// SPDX-License-Identifier: Apache-2.0
// cortex-ds402-sim: a CiA 402 drive behind Modbus/TCP that is a model. docs/ds402-simulator.md.
#include "sim/options.hpp"
#include "sim/server.hpp"

#include <csignal>
#include <exception>
#include <iostream>
#include <string>
#include <utility>

#include <sys/signalfd.h>

namespace cortex::modbus::sim {
namespace {

// Readable when the program is asked to end.
Descriptor stopSignals() {
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGINT);
    sigaddset(&signals, SIGTERM);
    sigprocmask(SIG_BLOCK, &signals, nullptr);
    std::signal(SIGPIPE, SIG_IGN);  // of a log that nobody reads any more
    return Descriptor{signalfd(-1, &signals, SFD_CLOEXEC)};
}

int run(int argc, char** argv) {
    int exitCode = 0;
    const auto line = parseCommandLine(argc, argv, exitCode);
    if (!line) return exitCode;
    const Descriptor end = stopSignals();
    Listener listener{line->address, line->port};
    std::cout << "cortex-ds402-sim: listening on " << listener.text() << std::endl;
    SimulatedDrive drive{line->drive, [&](const std::string& words) {
                             if (line->log) std::cout << words << std::endl;
                         }};
    Server{std::move(listener), drive, line->longestPause}.run(end.number());
    return 0;
}

}  // namespace
}  // namespace cortex::modbus::sim

int main(int argc, char** argv) {
    try {
        return cortex::modbus::sim::run(argc, argv);
    } catch (const std::exception& error) {
        std::cerr << "cortex-ds402-sim: " << error.what() << '\n';
        return 1;
    }
}
