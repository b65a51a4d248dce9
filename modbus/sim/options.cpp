// SPDX-License-Identifier: Apache-2.0
#include "sim/options.hpp"

#include <CLI/CLI.hpp>

namespace cortex::modbus::sim {
namespace {

constexpr const char* footerText =
    R"(It prints where it listens, and ends with SIGINT or SIGTERM. It speaks Modbus/TCP, function codes 3, 4,
6, 16 and 23, to up to 16 connections, one of which commands. Faults are commanded by registers.
Exit codes: 0 ended; 1 cannot listen; 2 usage.)";

void addDrive(CLI::App& app, DriveSettings& drive) {
    app.add_option("--axes", drive.axes, "axes of the drive; 1 if not given")
        ->type_name("N")
        ->check(CLI::Range(1, static_cast<int>(Ds402Map::axes)));
    app.add_flag("--absolute", drive.isAbsolute, "its encoders need no homing");
    app.add_option("--counts-per-unit", drive.countsPerUnit,
                   "encoder counts for one rad or m of an axis; 100000 if not given")
        ->type_name("N")
        ->check(aPositiveNumber);
    app.add_option("--rated-effort", drive.ratedEffort,
                   "N.m or N for 1000 per mille; 10 if not given")
        ->type_name("N")
        ->check(aPositiveNumber);
    app.add_option("--travel", drive.travel,
                   "rad or m from 0 to the limit switches; 3.2 if not given")
        ->type_name("N")
        ->check(aPositiveNumber);
    app.add_flag_callback(
        "--low-word-first", [&drive] { drive.wordOrder = WordOrder::LowWordFirst; },
        "the low word of a number of 32 bits comes first");
}

}  // namespace

std::optional<CommandLine> parseCommandLine(int argc, char** argv, int& exitCode) {
    CommandLine line;
    int pause = static_cast<int>(line.longestPause.count());
    int selfTest = static_cast<int>(line.drive.selfTest.count());
    CLI::App app{"Simulates a CiA 402 drive with one or two axes behind Modbus/TCP.", programName};
    app.footer(footerText);
    addServerOptions(app, line.server, "each transition, refused word and trip of the watchdog");
    addDrive(app, line.drive);
    app.add_option("--longest-pause", pause,
                   "pause of this process from which on its watchdog acts; 50 if not given, "
                   "0: none")
        ->type_name("MS")
        ->check(CLI::Range(0, 3600000));
    app.add_option("--self-test", selfTest,
                   "time from power on to its first word; 500 if not given")
        ->type_name("MS")
        ->check(CLI::Range(0, 60000));
    if (const std::optional<int> end = parse(app, argc, argv)) {
        exitCode = *end;
        return std::nullopt;
    }
    line.longestPause = std::chrono::milliseconds{pause};
    line.drive.selfTest = std::chrono::milliseconds{selfTest};
    return line;
}

}  // namespace cortex::modbus::sim
