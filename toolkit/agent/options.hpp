// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/network_options.hpp"
#include "cortex/core/error.hpp"
#include "cortex/core/event_memory.hpp"
#include "cortex/core/model_files.hpp"
#include "cortex/cs/cluster_cs.hpp"

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cortex::toolkit {

// What the command line asks for cannot be: exit code 2.
class UsageError : public Error {
public:
    using Error::Error;
};

// What was asked for on the command line.
struct CommandLine {
    std::filesystem::path system;
    std::vector<std::filesystem::path> plugins;
    std::vector<std::string> settings;  // PATH.ITEM=VALUE
    std::filesystem::path settingsFile, retainFile, memoryFile;
    std::size_t memoryEntries = EventMemory::usualEntries;
    std::string files;  // folder that simplexes may use
    std::optional<double> frequency;
    std::optional<std::uint32_t> threads;
    std::optional<int> priority;
    double spin = 0;     // us
    double seconds = 0;  // 0: until SIGINT or SIGTERM
    bool startup = false, checkHooks = false;
    bool wait = false;        // for another start of the name to end
    bool noDevices = false;   // a trial run: no device is talked to, nothing is kept
    bool validates = false;   // instead of running
    bool dumpsModel = false;  // likewise
    std::string modelPath;    // of the simplex that has it; empty: the only one
    std::filesystem::path log;
    bool offline = false;
    std::optional<int> domain;
    std::vector<std::string> interfaces, peers;
    std::optional<std::string> discoveryServer, security;
};

// Empty when the program is to end at once, with `exitCode`: help was shown, or usage was wrong.
std::optional<CommandLine> parseCommandLine(int argc, char** argv, int& exitCode);

// Where retained items are kept: as asked for, otherwise mixer.retained.xml beside mixer.xml.
std::filesystem::path retainFile(const CommandLine& line);
// Where what it remembers is kept: as asked for, otherwise mixer.memory beside the file of retained
// items; empty where there are none.
std::filesystem::path memoryFile(const CommandLine& line, bool retains);

struct ClusterSettings {
    std::string name;
    std::string triggerFrom;  // "fd:3", "udp:5005", "udp:127.0.0.1:5005"; empty: the clock
    Place place;
    std::chrono::nanoseconds period{}, spin{};
    cs::ClusterOptions options;
};

// Those of them with which `cortex` sees this agent: " --domain 7"; empty when it is offline.
std::optional<std::string> optionsOfTools(const CommandLine& line);

comms::NetworkOptions networkOptions(const CommandLine& line);

// The clock, or what the system file says. Throws Error with its place.
void setTrigger(cs::ClusterCS& cluster, const ClusterSettings& settings);

// The <cluster> of the system file, outranked by the command line. Throws Error.
ClusterSettings clusterSettings(const SystemDescription& system, const CommandLine& line);

}  // namespace cortex::toolkit
