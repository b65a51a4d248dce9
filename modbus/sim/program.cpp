// SPDX-License-Identifier: Apache-2.0
#include "sim/program.hpp"

#include "cortex/core/nearest_names.hpp"

#include "sim/server.hpp"

#include <algorithm>
#include <csignal>
#include <exception>
#include <iostream>
#include <utility>
#include <vector>

#include <sys/signalfd.h>

#include <CLI/CLI.hpp>

namespace cortex::modbus::sim {
namespace {

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

}  // namespace

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

void addServerOptions(CLI::App& app, ServerOptions& options, const std::string& logged) {
    app.set_version_flag("--version", app.get_name() + " " CORTEX_VERSION,
                         "Print the version and end");
    app.add_option("--port", options.port, "port to listen on; 0, if not given: any that is free")
        ->type_name("N")
        ->check(CLI::Range(0, 65535));
    app.add_option("--address", options.address,
                   "address to listen on, in numbers; 127.0.0.1 if not given")
        ->type_name("ADDR");
    app.add_flag("--log", options.log, "prints " + logged + " with its time");
}

std::optional<int> parse(CLI::App& app, int argc, char** argv) {
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        std::cerr << app.get_name() << ": " << wrongUsage(app, error)
                  << "\nhelp: " << app.get_name() << " --help\n";
        return usageError;
    }
    return std::nullopt;
}

void serve(const std::string& program, const ServerOptions& options,
           std::chrono::nanoseconds longestPause, const MakeDevice& make) {
    const Descriptor end = stopSignals();
    Listener listener{options.address, options.port};
    std::cout << program << ": listening on " << listener.text() << std::endl;
    const auto device = make([log = options.log](const std::string& words) {
        if (log) std::cout << words << std::endl;
    });
    Server{std::move(listener), *device, longestPause}.run(end.number());
}

int guarded(const std::string& program, const std::function<int()>& run) {
    try {
        return run();
    } catch (const std::exception& error) {
        std::cerr << program << ": " << error.what() << '\n';
        return 1;
    }
}

}  // namespace cortex::modbus::sim
