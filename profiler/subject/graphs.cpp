// SPDX-License-Identifier: Apache-2.0
#include "graphs.hpp"

#include <algorithm>
#include <random>
#include <string>

namespace cortex::profiler {
namespace {

using Edges = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Edges layered(std::uint32_t count) {
    const std::uint32_t width = std::max(1U, count / 16);
    Edges edges;
    for (std::uint32_t i = width; i < count; ++i) {
        const std::uint32_t layer = (i / width - 1) * width;
        edges.emplace_back(layer + i % width, i);
        edges.emplace_back(layer + (i + 1) % width, i);
    }
    return edges;
}

Edges random(std::uint32_t count) {
    std::mt19937 numbers{20231121};
    Edges edges;
    for (std::uint32_t i = 1; i < count; ++i) {
        std::vector<std::uint32_t> earlier;
        for (std::uint32_t n = numbers() % 4; n > 0; --n) {
            earlier.push_back(static_cast<std::uint32_t>(numbers() % i));
        }
        std::ranges::sort(earlier);
        const auto repeated = std::ranges::unique(earlier);
        earlier.erase(repeated.begin(), repeated.end());
        for (const std::uint32_t each : earlier) edges.emplace_back(each, i);
    }
    return edges;
}

}  // namespace

const char* name(Shape shape) {
    constexpr const char* names[]{"independent", "chained", "layered", "random"};
    return names[static_cast<int>(shape)];
}

TaskEdges makeEdges(Shape shape, std::uint32_t count) {
    TaskEdges graph{count, {}};
    if (shape == Shape::Layered) graph.edges = layered(count);
    if (shape == Shape::Random) graph.edges = random(count);
    if (shape == Shape::Chained) {
        for (std::uint32_t i = 1; i < count; ++i) {
            if (i % 4 != 0) graph.edges.emplace_back(i - 1, i);
        }
    }
    return graph;
}

std::string taskPath(std::uint32_t task) {
    const std::string number = std::to_string(task);
    return "/s" + std::string(6 - std::min<std::size_t>(6, number.size()), '0') + number;
}

SimplexTree simplexesOf(const TaskEdges& edges) {
    SimplexTree tree{subjectTypes()};
    std::vector<Simplex*> all;
    for (std::uint32_t i = 0; i < edges.count; ++i) {
        all.push_back(&tree.add<Empty>(taskPath(i), "Empty"));
    }
    for (const auto& [before, after] : edges.edges) {
        tree.relate(*all[after], "before", *all[before]);
    }
    return tree;
}

}  // namespace cortex::profiler
