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
    double allocated = 0, dirty = 0;  // octets
    double arena = 0;                 // of one image
    double images = 0;
};
MemorySample sampleFrom(Child& child);

// A cluster of so many empty simplexes: what it costs to start it and to run it.
struct SizeSample {
    double adding = 0;     // s, by whoever adds simplexes to the tree
    double starting = 0;   // s, from start() to the end of the first cycle
    double cycle = 0;      // ns, best of five rounds
    double allocated = 0;  // octets
};
std::vector<std::string> sizeWords(int count);
SizeSample sizeFrom(Child& child);

int playMemoryRole(const std::vector<std::string>& words);
int playSizeRole(const std::vector<std::string>& words);

}  // namespace cortex::profiler
