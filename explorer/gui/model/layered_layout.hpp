// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// Places the nodes of a directed graph in layers from left to right, with few crossings: longest
// paths give the layers, medians of neighbours the order within one (Sugiyama, Tagawa, Toda 1981;
// Gansner et al. 1993).
namespace cortex::gui {

struct LayoutEdge {
    std::uint32_t from = 0, to = 0;
    bool back = false;  // orders nothing; drawn back below the others
};

// Where something stands: layers count from the left, rows from above; rows may be fractions.
struct LayoutPoint {
    int layer = 0;
    double row = 0;
};

struct LayeredLayout {
    std::vector<LayoutPoint> nodes;
    std::vector<std::vector<LayoutPoint>> bends;  // of each edge, in the layers that it passes
    std::vector<bool> back;                       // of each edge: given, or it closed a loop
    std::vector<double> bottom;                   // of each edge: the last row of its component
    int layers = 0;
    double rows = 0;
    int crossings = 0;
};

LayeredLayout layered(std::size_t nodes, std::span<const LayoutEdge> edges);

}  // namespace cortex::gui
