// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "threads/scheduler.hpp"

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace cortex::cs {

/// Paths; a leading '-' marks a node without a task.
inline TaskGraph graphOf(const std::vector<std::string>& paths,
                         std::vector<std::pair<std::uint32_t, std::uint32_t>> edges) {
    TaskGraph graph;
    for (const std::string& path : paths) {
        const bool hasTask = path.front() != '-';
        graph.nodes.push_back({hasTask ? path : path.substr(1), hasTask, 1, 0});
    }
    graph.edges = std::move(edges);
    return graph;
}

/// A graph without loops: sparse or dense, with or without descriptive nodes, shuffled in name and
/// index, with duplicate edges.
inline TaskGraph randomGraph(std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto upTo = [&](std::uint32_t most) {
        return static_cast<std::uint32_t>(random() % most);
    };
    const std::uint32_t count = 2 + upTo(60);
    const std::uint32_t degree = 1 + upTo(seed % 3 == 0 ? 20 : 4);
    const std::uint32_t taskless = upTo(3) * 30;  // per cent
    std::vector<std::uint32_t> place(count);
    for (std::uint32_t i = 0; i < count; ++i) place[i] = i;
    std::shuffle(place.begin(), place.end(), random);
    TaskGraph graph;
    for (std::uint32_t i = 0; i < count; ++i) {
        graph.nodes.push_back({"/n" + std::to_string(random() % 1000) + "/" + std::to_string(i),
                               upTo(100) >= taskless, 1, 0});
    }
    for (std::uint32_t later = 1; later < count; ++later) {
        for (std::uint32_t k = upTo(degree + 1); k > 0; --k) {
            graph.edges.emplace_back(place[upTo(later)], place[later]);
        }
    }
    return graph;
}

/// reaches[a][b]: a must run before b. By brute force.
inline std::vector<std::vector<bool>> reachability(const TaskGraph& graph) {
    const std::size_t count = graph.nodes.size();
    std::vector<std::vector<bool>> reaches(count, std::vector<bool>(count));
    for (const auto& [before, after] : graph.edges) reaches[before][after] = true;
    for (std::size_t via = 0; via < count; ++via) {
        for (std::size_t from = 0; from < count; ++from) {
            for (std::size_t to = 0; reaches[from][via] && to < count; ++to) {
                if (reaches[via][to]) reaches[from][to] = true;
            }
        }
    }
    return reaches;
}

}  // namespace cortex::cs
