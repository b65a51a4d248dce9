// SPDX-License-Identifier: Apache-2.0
#include "sim/options.hpp"

#include "cortex/core/nearest_names.hpp"

#include <algorithm>
#include <iostream>
#include <vector>

#include <CLI/CLI.hpp>

namespace cortex::modbus::sim {
namespace {

constexpr int usageError = 2;

constexpr const char* footerText =
    R"(It prints where it listens, and ends with SIGINT or SIGTERM. It speaks Modbus/TCP, function codes 3, 4,
6, 16 and 23, to up to 16 connections, one of which commands. Faults are commanded by registers.
Exit codes: 0 ended; 1 cannot listen; 2 usage.)";

// "inf" and "nan" are numbers for CLI11.
std::string aPositiveNumber(const std::string& text) {
    std::size_t end = 0;
    double number = 0;
    try {
        number = std::stod(text, &end);
    } catch (const std::exception&) {
        end = 0;
    }
    const bool isGood = end == text.size() && number >= 1e-6 && number <= 1e9;
    return isGood ? "" : "'" + text + "' is no number from 1e-6 to 1e9; write it without a unit";
}

// Better than CLI11 says it: the nearest option.
std::string wrongUsage(const CLI::App& app, const CLI::ParseError& error) {
    const std::vector<std::string> unexpected = app.remaining();
    const auto option = std::ranges::find_if(
        unexpected, [](const std::string& each) { return each.starts_with("-"); });
    if (option == unexpected.end()) return error.what();
    std::vector<std::string> names;
    for (const CLI::Option* each : app.get_options())
        for (const std::string& name : each->get_lnames()) names.push_back("--" + name);
    const std::string wrong = option->substr(0, option->find('='));
    const std::string nearest = nearestNames(wrong, names);
    return "there is no option '" + wrong + "'" + (nearest.empty() ? "" : "; " + nearest);
}

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
    CLI::App app{"Simulates a CiA 402 drive with one or two axes behind Modbus/TCP."};
    app.name("cortex-ds402-sim")->footer(footerText);
    app.set_version_flag("--version", "cortex-ds402-sim " CORTEX_VERSION,
                         "Print the version and end");
    app.add_option("--port", line.port, "port to listen on; 0, if not given: any that is free")
        ->type_name("N")
        ->check(CLI::Range(0, 65535));
    app.add_option("--address", line.address,
                   "address to listen on, in numbers; 127.0.0.1 if not given")
        ->type_name("ADDR");
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
    app.add_flag("--log", line.log,
                 "prints each transition, refused word and trip of the watchdog with its time");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        exitCode = error.get_exit_code() == 0 ? app.exit(error) : usageError;
        if (exitCode != 0)
            std::cerr << "cortex-ds402-sim: " << wrongUsage(app, error)
                      << "\nhelp: cortex-ds402-sim --help\n";
        return std::nullopt;
    }
    line.longestPause = std::chrono::milliseconds{pause};
    line.drive.selfTest = std::chrono::milliseconds{selfTest};
    return line;
}

}  // namespace cortex::modbus::sim
