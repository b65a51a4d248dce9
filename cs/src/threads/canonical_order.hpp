// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace cortex::cs {

// What runs before what. Nodes are all simplexes, descriptive ones (without a task) included:
// they carry order from their writers to their readers.
struct TaskGraph {
    struct Node {
        std::string path;
        bool hasTask = false;
        std::uint32_t every = 1;  // runs in every n-th cycle; here it only weighs the cost
        std::uint32_t phase = 0;
    };
    std::vector<Node> nodes;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;  // (before, after)
};

// The graph has a loop that no delayed relationship opens; what() prints all of it by path.
class LoopError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// Topological, ties by path. Throws LoopError.
std::vector<std::uint32_t> canonicalOrder(const TaskGraph& graph);

}  // namespace cortex::cs
