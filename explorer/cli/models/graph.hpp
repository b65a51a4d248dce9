// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/structure.hpp"

#include "text/output.hpp"

#include <cstdint>
#include <memory>
#include <ostream>
#include <set>
#include <string>
#include <vector>

namespace cortex::cli {

// A structure and the order of execution that its relationships give: tasks of level n wait for
// nothing but tasks of lower levels. Only a structure without loops.
struct Graph {
    std::string title;  // of the system, or the names of agents
    std::shared_ptr<const Structure> structure;
    std::vector<std::vector<std::uint32_t>> levels;  // simplexes with a task, by path
    std::vector<std::uint32_t> levelOf;              // from 1; 0: no task
    std::vector<std::string> agentOf;                // of each simplex; "": not known
    std::set<std::string> lost;                      // agents that have fallen silent

    bool severalAgents() const;
    std::string agentText(std::uint32_t simplex) const;  // with what is wrong with it
};

// A relationship between simplexes of two agents gives no order: it takes a cycle or more.
Graph makeGraph(std::string title, const std::shared_ptr<const Structure>& structure,
                std::vector<std::string> agents, std::set<std::string> lost = {});

Json graphJson(const Graph& graph);  // schemas/graph.json
void printGraph(std::ostream& stream, const Graph& graph);
void printDot(std::ostream& stream, const Graph& graph);

}  // namespace cortex::cli
