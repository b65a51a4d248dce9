// SPDX-License-Identifier: Apache-2.0
#include "options.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/nearest_names.hpp"
#include "cortex/core/simplex_tree.hpp"
#include "cortex/core/value.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <map>
#include <sstream>

#include <CLI/CLI.hpp>

namespace cortex::toolkit {
namespace {

constexpr int usageError = 2;

constexpr const char* footerText =
    R"(Exit codes: 0 ended; 1 model refused, the report was printed; 2 usage; 3 halted or hung;
4 ended, but some simplexes did not follow --startup or the shutdown, they were named;
5 another start of its name was there first; 6 ended, but --check-hooks found something, and nothing of the above.
Settings of the loop stand in the system file, <cluster name="…" frequency="…" threads="…"
priority="…" overflow="…"/>; options outrank them. Files are looked for beside the file that names
them, in $CORTEX_PATH, and where CorteX is installed. A plug-in that brings the class of a type is
looked for in $CORTEX_AGENT_PLUGINS, ~/.local/lib/cortex/agent, and lib/cortex/agent beside the
program.)";

using Attributes = std::map<std::string, std::string>;

// The reader of system files has checked the forms already.
double number(const Attributes& attributes, const char* name, double otherwise) {
    const auto found = attributes.find(name);
    return found == attributes.end() ? otherwise : toFloat(found->second).value_or(otherwise);
}

std::uint32_t count(const Attributes& attributes, const char* name, std::uint32_t otherwise) {
    return static_cast<std::uint32_t>(number(attributes, name, otherwise));
}

std::string word(const Attributes& attributes, const char* name) {
    const auto found = attributes.find(name);
    return found == attributes.end() ? "" : found->second;
}

cs::Overflow overflowOf(const std::string& text) {
    if (text == "catchUp") return cs::Overflow::CatchUp;
    return text == "halt" ? cs::Overflow::Halt : cs::Overflow::Skip;
}

std::vector<int> cpusOf(const std::string& text) {
    std::vector<int> cpus;
    std::istringstream in{text};
    for (int cpu = 0; in >> cpu;) cpus.push_back(cpu);
    return cpus;
}

cs::ClusterOptions optionsOf(const Attributes& attributes, const CommandLine& line) {
    cs::ClusterOptions options;
    options.threads = line.threads.value_or(count(attributes, "threads", options.threads));
    options.priority =
        line.priority.value_or(static_cast<int>(number(attributes, "priority", options.priority)));
    options.acrossCaches = word(attributes, "acrossCaches") == "true";
    // A check of hooks sees memory that was never used, whatever rights the agent has.
    options.lockMemory = word(attributes, "lockMemory") != "false" && !line.checkHooks;
    options.keepCpusAwake = word(attributes, "keepCpusAwake") != "false";
    options.cpus = cpusOf(word(attributes, "cpus"));
    options.overflow = overflowOf(word(attributes, "overflow"));
    options.catchUpCycles = count(attributes, "catchUpCycles", options.catchUpCycles);
    options.warnDuty = number(attributes, "warnDuty", options.warnDuty);
    options.warnLateness = number(attributes, "warnLateness", options.warnLateness);
    options.haltLateness = number(attributes, "haltLateness", options.haltLateness);
    options.watchdogPeriods = number(attributes, "watchdogPeriods", options.watchdogPeriods);
    options.triggerTimeout = number(attributes, "triggerTimeout", options.triggerTimeout);
    options.stopTimeout = number(attributes, "stopTimeout", options.stopTimeout);
    options.controlRequired = word(attributes, "control") == "required";
    options.imageReaders = count(attributes, "imageReaders", options.imageReaders);
    return options;
}

// A range of CLI11 takes "nan", and calls what is no number out of range.
std::string aNumber(const std::string& text) {
    if (toFloat(text)) return {};
    const std::string digits = text.substr(0, text.find_first_not_of("0123456789.+-"));
    return "'" + text + "' is no number" +
           (toFloat(digits) ? "; write it without a unit (cortex-agent --help names it)" : "");
}

// Of --dump-mjcf, whose value may be left out.
std::string aPath(const std::string& text) {
    if (SimplexTree::pathError(text).empty()) return {};
    return "'" + text + "' is no path of a simplex; write the system file before this option";
}

void addDryStarts(CLI::App& app, CommandLine& line) {
    CLI::Option* validate =
        app.add_flag("--validate", line.validates,
                     "prints what a start would refuse or warn of as JSON, and ends: nothing runs; "
                     "`cortex validate` does so in words");
    app.add_option(
           "--dump-mjcf", line.modelPath,
           "prints the model of a MujocoWorld as MJCF, and ends: nothing runs; PATH chooses "
           "one of several")
        ->type_name("[PATH]")
        ->expected(0, 1)
        ->excludes(validate)
        ->check(aPath);
}

void addMemory(CLI::App& app, CommandLine& line) {
    CLI::Option* memory =
        app.add_option(
               "--memory", line.memoryFile,
               "file that keeps faults, commands, states, control and losses over restarts; if "
               "not given, SYSTEM.memory where there are items with retain=\"true\", otherwise "
               "none")
            ->type_name("FILE");
    app.add_flag("--no-devices", line.noDevices,
                 "a trial run: begins no thread of a device, so that what devices measure is lost; "
                 "reads retained values and keeps none")
        ->excludes(memory);
    app.add_option("--memory-entries", line.memoryEntries,
                   "how many of them are kept, with a file or without; 20000 if not given")
        ->type_name("N")
        ->check(CLI::Range(100, 1'000'000));
}

void addLoop(CLI::App& app, CommandLine& line) {
    app.add_option("--frequency", line.frequency, "cycles per second")
        ->type_name("HZ")
        ->check(aNumber)
        ->check(CLI::Range(0.01, 1e5));
    app.add_option("--threads", line.threads, "threads of the loop, its own included")
        ->type_name("N")
        ->check(CLI::Range(1, 256));
    app.add_option("--priority", line.priority, "real-time priority (SCHED_FIFO); 0: none")
        ->type_name("P")
        ->check(CLI::Range(0, 99));
    app.add_option(
           "--spin", line.spin,
           "polls the clock for so long before each cycle instead of sleeping; for isolated "
           "CPUs")
        ->type_name("US")
        ->check(aNumber)
        ->check(CLI::Range(0.0, 1e8));
}

void addNetwork(CLI::App& app, CommandLine& line) {
    CLI::Option* offline = app.add_flag("--offline", line.offline, "joins no network");
    app.add_option("--domain", line.domain,
                   "domain of the agents that see each other; CORTEX_DOMAIN or 0 if not given")
        ->type_name("N")
        ->check(CLI::Range(0, comms::lastDomain))
        ->excludes(offline);
    app.add_option("--interface", line.interfaces,
                   "address or name of a network interface to use; CORTEX_INTERFACE or all if not "
                   "given")
        ->type_name("ADDR")
        ->allow_extra_args(false)
        ->excludes(offline);
    app.add_option("--peer", line.peers, "host that multicast does not reach")
        ->type_name("HOST")
        ->allow_extra_args(false)
        ->excludes(offline);
    app.add_option("--discovery-server", line.discoveryServer,
                   "HOST:PORT of a Fast DDS Discovery Server, instead of multicast and peers; "
                   "several joined by ';'; CORTEX_DISCOVERY_SERVER or none if not given")
        ->type_name("ADDR")
        ->excludes(offline);
    app.add_option("--security", line.security,
                   "folder made by `cortex security create-agent`; CORTEX_SECURITY or no "
                   "security if not given")
        ->type_name("FOLDER")
        ->excludes(offline);
}

// Better than CLI11 says it: the nearest option, or the option that a file belongs to.
std::string wrongUsage(const CLI::App& app, const CLI::ParseError& error) {
    const std::vector<std::string> unexpected = app.remaining();
    const auto option = std::ranges::find_if(
        unexpected, [](const std::string& each) { return each.starts_with("-"); });
    if (option != unexpected.end()) {
        const std::string wrong = option->substr(0, option->find('='));
        std::vector<std::string> names;
        for (const CLI::Option* each : app.get_options()) {
            for (const std::string& name : each->get_lnames()) names.push_back("--" + name);
        }
        const std::string nearest = nearestNames(wrong, names);
        return "there is no option '" + wrong + "'" + (nearest.empty() ? "" : "; " + nearest);
    }
    if (unexpected.empty() || dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr) {
        return error.what();
    }
    const std::string& wrong = unexpected.front();
    if (wrong.ends_with(".xml")) {
        return "'" + wrong +
               "' was not expected: one agent runs one system file; start another "
               "cortex-agent for it";
    }
    return "'" + wrong + "' was not expected" +
           (wrong.ends_with(".so") ? "; did you mean --plugin " + wrong + "?" : "");
}

}  // namespace

std::optional<CommandLine> parseCommandLine(int argc, char** argv, int& exitCode) {
    CommandLine line;
    CLI::App app{"Runs a system file with the toolkit's types and those of plug-ins."};
    app.name("cortex-agent")->footer(footerText);
    app.add_option("SYSTEM.xml", line.system, "the system file")->required()->type_name("");
    app.add_option("--plugin", line.plugins,
                   "shared object with classes of active types; once for each")
        ->type_name("FILE")
        ->allow_extra_args(false);
    app.add_option("--set", line.settings, "value that an item starts with; once for each")
        ->type_name("PATH.ITEM=VALUE")
        ->allow_extra_args(false);
    app.add_option("--settings", line.settingsFile,
                   "file that `cortex save` wrote: values that items start with")
        ->type_name("FILE");
    app.add_option("--retain", line.retainFile,
                   "file that keeps items with retain=\"true\" over restarts; SYSTEM.retained.xml "
                   "beside the system file if not given")
        ->type_name("FILE");
    addMemory(app, line);
    app.add_option("--files", line.files,
                   "folder below which simplexes may read and write files, such as taught points; "
                   "none if not given")
        ->type_name("FOLDER");
    addLoop(app, line);
    app.add_option("--seconds", line.seconds,
                   "ends so long after the start, with --startup after the end of the start-up; "
                   "otherwise with SIGINT or SIGTERM")
        ->type_name("S")
        ->check(aNumber)
        ->check(CLI::Range(1e-3, 1e9));
    app.add_flag("--wait", line.wait,
                 "while another start of its name is there, waits until that one has ended");
    app.add_flag("--startup", line.startup, "starts all active simplexes");
    app.add_flag(
        "--check-hooks", line.checkHooks,
        "names each allocation, lock, system call, page fault, throw and output of a hook");
    addDryStarts(app, line);
    app.add_option("--log", line.log, "writes events to a file instead of the standard error")
        ->type_name("FILE");
    addNetwork(app, line);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        exitCode = error.get_exit_code() == 0 ? app.exit(error) : usageError;
        if (exitCode != 0) {
            std::cerr << "cortex-agent: " << wrongUsage(app, error)
                      << "\nhelp: cortex-agent --help\n";
        }
        return std::nullopt;
    }
    line.dumpsModel = app.count("--dump-mjcf") > 0;
    return line;
}

std::filesystem::path retainFile(const CommandLine& line) {
    if (!line.retainFile.empty()) return line.retainFile;
    std::filesystem::path file = line.system;
    return file.replace_extension(".retained.xml");
}

std::filesystem::path memoryFile(const CommandLine& line, bool retains) {
    if (!line.memoryFile.empty() || !retains) return line.memoryFile;
    std::filesystem::path file = retainFile(line);
    for (const char* each : {".xml", ".retained"}) {
        if (file.extension() == each) file.replace_extension();
    }
    return file += ".memory";
}

comms::NetworkOptions networkOptions(const CommandLine& line) {
    comms::NetworkOptions options;
    if (line.domain) options.domain = *line.domain;
    if (!line.interfaces.empty()) options.interfaces = line.interfaces;
    options.peers = line.peers;
    if (line.discoveryServer) options.discoveryServer = *line.discoveryServer;
    if (line.security) options.security = *line.security;
    options.onSecondStart = line.wait ? comms::OnSecondStart::Waits : comms::OnSecondStart::Refused;
    options.waitForFirst = [](const std::function<bool()>& ended) {
        std::cerr << "another start of its name is there; this one waits until it has ended"
                  << std::endl;
        return !cs::waitForInterrupt(0, ended);
    };
    return options;
}

std::optional<std::string> optionsOfTools(const CommandLine& line) {
    if (line.offline) return {};
    std::string text;
    if (line.domain) text += " --domain " + std::to_string(*line.domain);
    for (const std::string& each : line.interfaces) text += " --interface " + each;
    if (line.discoveryServer) text += " --discovery-server " + *line.discoveryServer;
    if (line.security) text += " --security FOLDER";
    return text;
}

void setTrigger(cs::ClusterCS& cluster, const ClusterSettings& settings) {
    const std::string& from = settings.triggerFrom;
    if (from.empty()) {
        cluster.setTriggerSource<cs::InternalClock>(settings.period, settings.spin);
        return;
    }
    const std::size_t first = from.find(':'), last = from.rfind(':');
    const int number = static_cast<int>(toInt(from.substr(last + 1)).value_or(0));
    const std::string address =
        first == last ? "127.0.0.1" : from.substr(first + 1, last - first - 1);
    try {
        const int descriptor =
            from.starts_with("fd:")
                ? number
                : cs::DescriptorTrigger::openUdp(address, static_cast<std::uint16_t>(number));
        cluster.setTriggerSource<cs::DescriptorTrigger>(descriptor, settings.period);
    } catch (const Error& error) {
        throw Error(settings.place.text() + ": triggerFrom=\"" + from + "\": " + error.what());
    }
}

ClusterSettings clusterSettings(const SystemDescription& system, const CommandLine& line) {
    if (system.clusters.size() != 1) {
        throw Error(line.system.string() + ": has " + std::to_string(system.clusters.size()) +
                    " clusters, an agent runs one: write one <cluster name=\"…\" "
                    "frequency=\"1000\"/>");
    }
    const SystemDescription::ClusterEntry& entry = system.clusters.front();
    const double frequency = line.frequency.value_or(number(entry.attributes, "frequency", 1000));
    ClusterSettings settings;
    settings.name = entry.name;
    settings.place = entry.place;
    settings.triggerFrom = word(entry.attributes, "triggerFrom");
    if (line.spin > 0 && !settings.triggerFrom.empty()) {
        throw Error(entry.place.text() + ": ticks come from " + settings.triggerFrom +
                    ", and only a clock can spin: leave --spin out");
    }
    settings.period = std::chrono::nanoseconds{std::llround(1e9 / frequency)};
    settings.spin = std::chrono::nanoseconds{std::llround(1e3 * line.spin)};
    settings.options = optionsOf(entry.attributes, line);
    settings.options.devices = !line.noDevices;
    settings.options.files = line.files;
    return settings;
}

}  // namespace cortex::toolkit
