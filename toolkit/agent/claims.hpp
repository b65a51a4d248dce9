// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/error.hpp"

#include "devices.hpp"
#include "host_claims.hpp"
#include "options.hpp"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cortex::toolkit {

// Another process of this host has what this one needs: exit code 5.
class Taken : public Error {
public:
    using Error::Error;
};

// What an agent has to itself on this host: the file of its retained values, and its devices.
// With --no-devices it has none of them. Throws Taken. With --wait it waits, or goes on: on a
// network that knows who has ended, whoever still has it a second later stands still.
class Claims {
public:
    explicit Claims(const CommandLine& line) : line_{line} {}

    // Before the values are read.
    void takeFile(const std::filesystem::path& retained);
    // When the network has said that the name is free. The file once more, too.
    void takeAll(const std::vector<TalkedTo>& devices);

private:
    struct Thing {
        std::string key, text, remedy;
    };
    void take(const Thing& thing);
    bool comesFree(const Thing& thing);

    const CommandLine& line_;
    HostClaims claims_;
    std::optional<Thing> file_;
    std::optional<std::chrono::steady_clock::time_point> patience_;  // ends then
};

}  // namespace cortex::toolkit
