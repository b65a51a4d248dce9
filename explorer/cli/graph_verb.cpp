// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agent.hpp"

#include "graph.hpp"
#include "verbs.hpp"

#include <algorithm>
#include <iostream>

namespace cortex::explorer {

Exit showGraph(const GraphOptions& options) {
    const bool several = options.files.size() > 1;
    const auto systems = several ? std::ranges::count_if(options.files, isSystem) : 0;
    if (systems > 1) {
        throw Failure{Usage, "a graph is of one system, these files have " +
                                 std::to_string(systems) + ": give one of them"};
    }
    const Model model = readSystem(options.files);
    requireValid(model);
    if (!model.hasSystem) {
        throw Failure{Usage, "none of these files is a system: give one whose element is <system>"};
    }
    const SystemDescription& system = model.tree->description();
    const std::string agent = system.clusters.empty() ? "" : system.clusters.front().name;
    const Graph graph = makeGraph(system.name, makeStructure(agent, *model.tree));
    if (options.json) {
        print(graphJson(graph));
    } else if (options.dot) {
        printDot(std::cout, graph);
    } else {
        printGraph(std::cout, graph);
    }
    return Yes;
}

}  // namespace cortex::explorer
