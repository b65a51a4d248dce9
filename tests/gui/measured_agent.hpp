// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/made_agent.hpp"

#include <array>
#include <string>
#include <utility>

namespace cortex::test {

// An agent with its own simplex alone.
inline MadeAgent clusterNamed(const std::string& name, const std::string& type = "Cluster") {
    return {name, [&](SimplexTree& tree) { tree.add("/" + name, type); }};
}

// What a loop at 1 kHz measures.
inline void measure(MadeAgent& agent, const std::string& path) {
    constexpr std::array<std::pair<const char*, double>, 5> endings{
        {{"Last", 1.2}, {"P50", 1}, {"P99", 2}, {"P999", 4}, {"Max", 9}}};
    for (const auto& [ending, factor] : endings) {
        agent.put(path, std::string{"cycleDuration"} + ending, 1000 + factor);
        agent.put(path, std::string{"jitter"} + ending, factor);
        agent.put(path, std::string{"dutyCycle"} + ending, factor * 10);
    }
}

}  // namespace cortex::test
