// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "child.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace cortex::profiler {

// An agent of a thousand items on the network, whose load changes all the time, until its standard
// input ends. It says when it runs, and then once a second what it is.
struct EnduranceRole {
    int domain = 1;
    std::uint32_t threads = 1;
    double frequency = 1000;
    int priority = 0;
};
std::vector<std::string> wordsOf(const EnduranceRole& role);

struct EnduranceSample {
    double time = 0;                                                  // s since it runs
    double allocated = 0, resident = 0, proportional = 0, dirty = 0;  // octets
    double handles = 0, threads = 0;
    double loopAllocations = 0, cycles = 0;
    double tables = 0;  // octets of one image
};
EnduranceSample enduranceFrom(Child& child);

int playEnduranceRole(const std::vector<std::string>& words);

}  // namespace cortex::profiler
