// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace cortex::gui {

// A simplex, or a family: siblings 1..n of one type, or of children of one, that are related alike.
struct GraphNode {
    std::string key;  // its path; of a family that of its parent with "/*"
    std::string type;
    std::vector<std::string> paths;
    bool family() const { return paths.size() > 1; }
};

// Values that flow, whoever of the two states the relationship.
struct GraphEdge {
    std::uint32_t from = 0, to = 0;
    std::vector<std::string> rules;
    bool delayed = false;
};

// The simplexes of all agents that are related, joined by the flow of their values.
struct SystemGraph {
    std::vector<GraphNode> nodes;  // by path
    std::vector<GraphEdge> edges;
    int unrelated = 0;  // simplexes without a relationship, which are left out
    std::uint32_t find(const std::string& path) const;  // noSimplex: it is not shown
};

// Families whose keys are in `open` are shown one by one.
SystemGraph makeSystemGraph(const Frame& frame, const std::set<std::string>& open);

}  // namespace cortex::gui
