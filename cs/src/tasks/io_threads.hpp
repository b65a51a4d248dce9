// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/io_exchange.hpp"

#include <span>
#include <string>
#include <vector>

namespace cortex::cs {

// The threads that simplexes of a cluster have beside the tick. Program's thread.
class IoThreads {
public:
    ~IoThreads() { end(); }

    // When the loop runs.
    void begin(std::span<SimplexCS* const> simplexes);
    // After the last cycle: asks all to end, and waits for 2 s in sum. What does not return, as a
    // sentence; empty: all have ended.
    std::string end();

private:
    std::vector<ThreadedSimplex*> simplexes_;  // whose thread runs
};

}  // namespace cortex::cs
