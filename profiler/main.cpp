// SPDX-License-Identifier: Apache-2.0
// cortex-profiler: measures this machine's CorteX, writes a report, compares two, and looks at a
// running agent.
#include "cortex/core/error.hpp"

#include "child.hpp"
#include "measure/attach.hpp"
#include "measure/run.hpp"
#include "measure/terminal_progress.hpp"
#include "report/comparison.hpp"
#include "report/machine_facts.hpp"
#include "report/results_files.hpp"
#include "report/summary_text.hpp"

#include <algorithm>
#include <functional>
#include <iostream>

#include <unistd.h>

#include <CLI/CLI.hpp>

namespace cortex::profiler {
namespace {

constexpr int usageError = 2;

struct Arguments {
    RunRequest run;
    AttachRequest attach;
    std::string folder, other;
    std::function<int()> chosen;
};

void addFolder(CLI::App& verb, std::filesystem::path& folder, bool& force) {
    verb.add_option("-o,--out", folder,
                    "Folder for the results; profile-<UTC time> here if not given")
        ->type_name("DIR");
    verb.add_flag("--force", force, "Write into a folder that is not empty");
}

void addRun(CLI::App& app, Arguments& arguments) {
    CLI::App* verb = app.add_subcommand("run", "Measure, and write a report");
    verb->footer(measurementHelp() + R"(
Writes report.html, results.json, summary.csv, and a CSV file and a picture per figure, after each
measurement. The pictures take gnuplot (Debian: gnuplot-nox). Each aim is met, missed, or not judged
where the machine was too noisy. Exit code 4: an aim was missed.
For figures that mean something: a machine without other load, as root or with CAP_SYS_NICE.
Examples:
  cortex-profiler run                                  everything
  cortex-profiler run --quick --out /tmp/profile       a first look
  cortex-profiler run duty jitter --priority 80        two of them, with real-time threads
  cortex-profiler run latency --threads 1 --frequency 500)");
    RunOptions& options = arguments.run.options;
    verb->add_option("MEASUREMENT", arguments.run.names, "Which; see below")
        ->type_name("")
        ->check(CLI::IsMember(measurementNames()));
    verb->add_flag("--quick", options.quick, "Shorter and coarser, for a first look");
    verb->add_option("--threads", options.threads,
                     "Threads of the loop; as many as CPUs may be used, at most 4, if not given")
        ->type_name("N")
        ->check(CLI::Range(1, 64));
    verb->add_option("--frequency", options.frequency,
                     "Of the loop, where it is not what is varied; 1000 if not given")
        ->type_name("HZ")
        ->check(CLI::Range(1.0, 100'000.0));
    verb->add_option("--priority", options.priority,
                     "SCHED_FIFO priority of the loop's threads; none if not given")
        ->type_name("1-99")
        ->check(CLI::Range(1, 99));
    addFolder(*verb, arguments.run.folder, arguments.run.force);
    verb->callback([&] { arguments.chosen = [&] { return runMeasurements(arguments.run); }; });
}

void addReport(CLI::App& app, Arguments& arguments) {
    CLI::App* verb = app.add_subcommand("report", "Write the report of a run again");
    verb->footer(R"(From its results.json alone, for example with a newer version of this program.
Example:
  cortex-profiler report profile-20260101T120000Z)");
    verb->add_option("DIR", arguments.folder, "Folder of a run")->required()->type_name("");
    verb->callback([&] {
        arguments.chosen = [&] {
            const Results results = load(arguments.folder);
            save(results, arguments.folder);
            tellResults(results, arguments.folder);
            return 0;
        };
    });
}

int compareFolders(const std::string& before, const std::string& after) {
    const Comparison comparison = compare(load(before), load(after));
    std::cout << comparisonText(comparison, terminalWidth(STDOUT_FILENO));
    const bool worse = std::ranges::any_of(
        comparison.quantities, [](const Compared& each) { return each.change == Change::Worse; });
    return worse ? 1 : 0;
}

void addCompare(CLI::App& app, Arguments& arguments) {
    CLI::App* verb = app.add_subcommand("compare", "Compare two runs");
    verb->footer(
        R"(Says what is worse, what is better and what is noise. Exit code 1: something is worse.
Example:
  cortex-profiler compare before after)");
    verb->add_option("BEFORE", arguments.folder, "Folder of the first run")
        ->required()
        ->type_name("");
    verb->add_option("AFTER", arguments.other, "Folder of the second run")
        ->required()
        ->type_name("");
    verb->callback([&] {
        arguments.chosen = [&] { return compareFolders(arguments.folder, arguments.other); };
    });
}

void addAttach(CLI::App& app, Arguments& arguments) {
    CLI::App* verb = app.add_subcommand("attach", "Look at the metrics of a running agent");
    verb->footer(
        R"(Takes what the agent shows as data: time between cycles, jitter, lateness, duty cycle, missed ticks,
latency of commands, and the task times of its simplexes. Nothing in the agent is changed.
Examples:
  cortex-profiler attach arm
  cortex-profiler attach arm --domain 7 --interface lo --seconds 120 --out arm-today)");
    AttachRequest& request = arguments.attach;
    verb->add_option("AGENT", request.agent, "Name of the agent")->required()->type_name("");
    verb->add_option("--domain", request.network.domain,
                     "Domain of the agent; CORTEX_DOMAIN, else 0, if not given")
        ->type_name("N")
        ->check(CLI::Range(0, 230));
    verb->add_option("--interface", request.network.interfaces,
                     "Address or name of a network interface to use; all if not given")
        ->type_name("ADDR")
        ->allow_extra_args(false);
    verb->add_option("--seconds", request.seconds, "How long to look; 30 if not given")
        ->type_name("S")
        ->check(CLI::Range(0.5, 1e6));
    verb->add_option("--timeout", request.timeout, "How long to wait for it; 5 s if not given")
        ->type_name("S")
        ->check(CLI::Range(0.001, 1e6));
    addFolder(*verb, request.folder, request.force);
    verb->callback([&] { arguments.chosen = [&] { return attach(request); }; });
}

std::string typed(int count, char** values) {
    std::string text = "cortex-profiler";
    for (int i = 1; i < count; ++i) text += std::string{" "} + values[i];
    return text;
}

int refuse(const CLI::App& app, const std::string& wrong) {
    const auto verbs = app.get_subcommands();
    std::cerr << "cortex-profiler: " << wrong << "\nhelp: cortex-profiler "
              << (verbs.empty() ? "" : verbs.front()->get_name() + " ") << "--help\n";
    return usageError;
}

int parse(CLI::App& app, int count, char** values) {
    if (count < 2) {
        std::cerr << app.help();
        return usageError;
    }
    try {
        app.parse(count, values);
    } catch (const CLI::Success& asked) {
        app.exit(asked);
    } catch (const CLI::ParseError& error) {
        return refuse(app, error.what());
    }
    return 0;
}

int runProgram(int count, char** values) {
    Arguments arguments;
    CLI::App app{"cortex-profiler: how fast and how timely CorteX is on this machine",
                 "cortex-profiler"};
    app.footer(R"(Exit codes: 0 done, 1 failed, stopped or worse, 2 wrong usage.
4 an aim of `run` was missed; what could not be judged was not missed.
Help on a verb: cortex-profiler VERB --help)");
    app.set_version_flag("--version", "cortex-profiler " CORTEX_VERSION,
                         "Print the version and end");
    app.require_subcommand(1);
    app.get_formatter()->column_width(28);
    arguments.run.command = arguments.attach.command = typed(count, values);
    addRun(app, arguments);
    addReport(app, arguments);
    addCompare(app, arguments);
    addAttach(app, arguments);
    const int parsed = parse(app, count, values);
    if (parsed != 0 || !arguments.chosen) return parsed;
    try {
        return arguments.chosen();
    } catch (const std::exception& error) {
        std::cerr << "cortex-profiler: " << error.what() << '\n';
        return 1;
    }
}

}  // namespace
}  // namespace cortex::profiler

int main(int count, char** values) {
    if (const auto ended = cortex::profiler::playChildRole(count, values)) return *ended;
    return cortex::profiler::runProgram(count, values);
}
