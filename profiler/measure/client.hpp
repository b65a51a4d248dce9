// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "child.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace cortex::profiler {

// A tool in a process of its own that looks at everything of the agent `subject` so many times a
// second, 0 for every cycle. Says "ready" when values are there, then does so for the seconds that
// begin with a line on its standard input, until that ends.
std::vector<std::string> clientWords(int number, int rate, int domain);

// What it saw. An image is whole if all simplexes have come and their values are of one cycle.
struct ClientSample {
    std::int64_t images = 0, whole = 0;
};
ClientSample sampleOf(Child& client);  // after end()

int playClient(const std::vector<std::string>& words);

}  // namespace cortex::profiler
