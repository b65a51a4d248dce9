// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/command.hpp"

#include "live/live.hpp"

#include <chrono>
#include <optional>
#include <string>

namespace cortex::cli {

// How far a long command has come, on standard error while its answer is waited for: on a terminal
// on one line, which is gone at the end; elsewhere a line at most once a second.
class Progress {
public:
    Progress(Live& live, const FoundSimplex& simplex, const CommandTable::Entry& command);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void look();
    // The share in % if the command is seen to run now; empty while nothing is known of it.
    std::optional<long> percent() const;

private:
    Live& live_;
    FoundSimplex simplex_;
    std::string command_, shown_;
    bool follows_, onTerminal_;
    std::chrono::steady_clock::time_point next_{};
};

}  // namespace cortex::cli
