// SPDX-License-Identifier: Apache-2.0
#include "run.hpp"

#include "cortex/core/error.hpp"

#include "measure/measurements.hpp"
#include "measure/terminal_progress.hpp"
#include "report/machine_facts.hpp"
#include "report/quantity_text.hpp"
#include "report/results_files.hpp"
#include "report/summary_text.hpp"

#include <algorithm>
#include <array>
#include <ctime>
#include <iostream>
#include <span>

#include <unistd.h>

namespace cortex::profiler {
namespace {

std::span<const Measurement> measurements() {
    static const std::array all{memoryMeasurement(),    dutyMeasurement(),   intervalMeasurement(),
                                latencyMeasurement(),   jitterMeasurement(), commandsMeasurement(),
                                schedulerMeasurement(), accessMeasurement(), commsMeasurement(),
                                observersMeasurement()};
    return all;
}

constexpr std::string_view dutyName = "duty", intervalName = "interval";

std::string utcTime(const char* format) {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    gmtime_r(&now, &parts);
    char text[32];
    std::strftime(text, sizeof text, format, &parts);
    return text;
}

std::vector<const Measurement*> chosen(const std::vector<std::string>& names) {
    const bool all = names.empty() || std::ranges::count(names, "all") > 0;
    std::vector<const Measurement*> found;
    for (const Measurement& each : measurements()) {
        if (all || std::ranges::count(names, each.name) > 0) found.push_back(&each);
    }
    return found;
}

// `interval` looks at what `duty` has measured just before.
double secondsOf(const Measurement& each, const std::vector<const Measurement*>& list,
                 const RunOptions& options) {
    const auto isDuty = [](const Measurement* other) { return other->name == dutyName; };
    const bool shared = each.name == intervalName && std::ranges::any_of(list, isDuty);
    return shared ? 0.1 : each.seconds(options);
}

// False: it failed.
bool runOne(const Measurement& measurement, const RunOptions& options, TerminalProgress& progress,
            Results& results) {
    const auto before = static_cast<std::ptrdiff_t>(results.quantities.size());
    bool whole = true;
    try {
        measurement.run(options, progress, results);
    } catch (const std::exception& error) {
        results.notes.push_back(std::string{measurement.name} + " failed: " + error.what());
        whole = false;
    }
    for (auto each = results.quantities.begin() + before; each != results.quantities.end();
         ++each) {
        each->group = measurement.heading;
    }
    return whole;
}

}  // namespace

std::string measurementHelp() {
    std::string text = "Measurements:\n  all         every one of them, if none is named\n";
    for (const Measurement& each : measurements()) {
        std::string name = each.name;
        name.resize(std::max<std::size_t>(name.size(), 11), ' ');
        text += "  " + name + " " + each.what + "\n";
    }
    return text;
}

std::vector<std::string> measurementNames() {
    std::vector<std::string> names{"all"};
    for (const Measurement& each : measurements()) names.emplace_back(each.name);
    return names;
}

std::filesystem::path makeFolder(const std::filesystem::path& wanted, bool force) {
    namespace fs = std::filesystem;
    const fs::path folder = wanted.empty() ? fs::path{utcTime("profile-%Y%m%dT%H%M%SZ")} : wanted;
    std::error_code error;
    const bool exists = fs::exists(folder, error);
    if (exists && !fs::is_directory(folder)) throw Error(folder.string() + " is not a folder");
    if (exists && !force && !fs::is_empty(folder)) {
        throw Error(folder.string() +
                    " is not empty; name another folder, or give --force to replace its results");
    }
    fs::create_directories(folder, error);
    if (error) throw Error("cannot make " + folder.string() + ": " + error.message());
    return folder;
}

Results newResults(const std::string& command) {
    Results results;
    results.started = utcTime("%Y-%m-%dT%H:%M:%SZ");
    results.command = command;
    results.version = CORTEX_VERSION;
    results.machine = machineFacts();
    return results;
}

int tellResults(const Results& results, const std::filesystem::path& folder) {
    std::cout << summaryText(results, terminalWidth(STDOUT_FILENO))
              << "Results: " << (folder / "report.html").string() << std::endl;
    return exitCodeOf(results);
}

int runMeasurements(const RunRequest& request) {
    const std::vector<const Measurement*> list = chosen(request.names);
    const std::filesystem::path folder = makeFolder(request.folder, request.force);
    double seconds = 0;
    for (const Measurement* each : list) seconds += secondsOf(*each, list, request.options);
    std::cerr << "Takes about " << durationText(seconds) << "; Ctrl-C keeps what there is.\n";

    Results results = newResults(request.command);
    bool whole = true;
    noteStopSignals();
    {
        TerminalProgress progress{seconds};
        for (const Measurement* each : list) {
            progress.begin(each->name, secondsOf(*each, list, request.options));
            whole = runOne(*each, request.options, progress, results) && whole;
            results.complete = each == list.back() && whole && !stopAsked();
            if (stopAsked()) results.notes.push_back("Stopped: not everything was measured.");
            save(results, folder);
            if (stopAsked()) break;
        }
    }
    return tellResults(results, folder);
}

}  // namespace cortex::profiler
