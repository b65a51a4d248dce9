// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "live/live.hpp"
#include "text/output.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

// The verbs that look at agents on a network. They print and return the exit code, or throw
// Failure.
namespace cortex::cli {

struct LiveOptions {
    NetworkArguments network;
    bool json = false;
};

Exit listAgents(const LiveOptions& options);

Exit examine(const LiveOptions& options);  // cortex doctor

struct ListOptions : LiveOptions {
    std::string prefix = "/";
};
Exit listSimplexes(const ListOptions& options);

struct ShowOptions : LiveOptions {
    std::string path;
};
Exit showSimplex(const ShowOptions& options);

struct WatchOptions : LiveOptions {
    std::vector<std::string> what;  // PATH or PATH.item
    std::uint32_t rate = 5;         // images per second; 0: every cycle
    std::uint64_t count = 0;        // images; 0: for ever
    bool csv = false;
    bool labels = false;  // in CSV, in place of their numbers
};
Exit watchValues(const WatchOptions& options);

struct CommandingOptions : LiveOptions {
    bool take = false;   // control, for as long as it takes
    std::string person;  // on behalf of whom; empty: of whoever uses the program
};

struct CallOptions : CommandingOptions {
    std::string path, command;
    std::vector<std::string> arguments;  // name=value
};
Exit callCommand(const CallOptions& options);
Exit setItems(const CallOptions& options);
// What was meant by a path that has an item, or by no items.
std::string howToSet(const std::string& path,
                     const std::vector<std::string>& arguments);  // command "set"

Exit listLeases(const LiveOptions& options);
Exit listPeople(const LiveOptions& options);

struct EventOptions : LiveOptions {
    std::string prefix = "/";
    bool follow = false, csv = false;
    std::string severity = "info";
    std::vector<std::string> kinds;           // empty: all
    std::optional<std::string> since, until;  // as they were written
    bool beforeFault = false;
    double seconds = 10;  // before it
};
Exit showEvents(const EventOptions& options);

struct SaveOptions : LiveOptions {
    std::string file, prefix = "/";
    bool force = false;
};
Exit saveItems(const SaveOptions& options);

struct RestoreOptions : CommandingOptions {
    std::string file;
    bool dryRun = false, whatIsGood = false;
};
Exit restoreItems(const RestoreOptions& options);

struct ConformOptions : CommandingOptions {
    std::vector<std::string> paths;  // of devices
    std::string junit;               // file; empty: none
    bool force = false, home = false;
    std::optional<double> move;  // amplitude in the unit of the axis; none: nothing moves
    std::optional<double> grip;  // m, between the jaws, 0: nothing; none: it does not grip
    double speed = 0.25;         // share of the axis' greatest speed
    double seconds = 60;         // in which exchanges are counted
};
Exit testConformance(const ConformOptions& options);

struct TopOptions : LiveOptions {
    std::string prefix = "/";
    std::optional<double> rate;     // refreshes per second; none: as fits where they go
    std::optional<double> seconds;  // none: for ever
    bool once = false, untilGone = false;
};
Exit showTop(const TopOptions& options);

}  // namespace cortex::cli
