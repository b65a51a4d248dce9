// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace cortex::profiler {

template <class Function>
std::chrono::nanoseconds timed(const Function& function) {
    const auto begin = std::chrono::steady_clock::now();
    function();
    return std::chrono::steady_clock::now() - begin;
}

// One of several that are measured in turn, so that what else the machine does meets all of them.
struct Contender {
    std::string name;
    std::function<std::chrono::nanoseconds(std::int64_t cycles)> run;
    std::vector<double> rounds{};  // ns of one cycle: the best millisecond of each round

    double best() const;
};

// Warms each up, then measures each for about so long in each round.
struct Rounds {
    int count = 5;
    double seconds = 0.02;
};
void measureInTurn(std::vector<Contender>& contenders, const Rounds& rounds);

}  // namespace cortex::profiler
