// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "child.hpp"
#include "subject/generated_types.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace cortex::profiler {

// A cluster in a process of its own, at 1 kHz for so long, that tells ten times a second what its
// process has taken since it began: types, tree, tables, images and threads.
struct MemoryRole {
    Content content = Content::Nothing;
    int count = 0;  // of simplexes, or of what each of 25 contains
    double seconds = 0;
    std::uint32_t imageReaders = 8;
};
std::vector<std::string> wordsOf(const MemoryRole& role);

struct MemorySample {
    double allocated = 0;  // bytes
    double arena = 0;      // of one image
    double images = 0;
    double allocations = 0;  // calls of the allocator by the loop's threads
};
MemorySample sampleFrom(Child& child);

int playMemoryRole(const std::vector<std::string>& words);

}  // namespace cortex::profiler
