// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "child.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace cortex::observers {

// What one client process does until its standard input ends: looks at everything so many times a
// second, or at every cycle, or sends a command a second, or 50.
enum class Load { View30, ViewEvery, Command, CommandOften };

int runClient(int number, Load load, int domain);

// A number of client processes of this program.
class Clients {
public:
    void start(int number, Load load, int domain);
    void waitUntilReady();  // throws Error if one ended instead
    // Ends them; images that they saw, or commands that were done.
    std::vector<std::uint64_t> stop();

private:
    std::vector<std::unique_ptr<profiler::Child>> clients_;
};

}  // namespace cortex::observers
