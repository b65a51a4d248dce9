// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agent.hpp"
#include "cortex/core/make_structure.hpp"

#include "live/live_models.hpp"
#include "models/graph.hpp"
#include "verbs/verbs.hpp"

#include <algorithm>
#include <iostream>
#include <optional>

namespace cortex::cli {

namespace {

Graph graphOf(const GraphOptions& options) {
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
    const std::shared_ptr<const Structure> structure = makeStructure(agent, *model.tree);
    std::vector<std::string> agents;
    for (const SimplexInfo& each : structure->simplexes) agents.push_back(each.remote ? "" : agent);
    return makeGraph(system.name, structure, std::move(agents));
}

}  // namespace

// Without files: that of all agents on the network.
Exit showGraph(const GraphOptions& options) {
    std::optional<Live> live;
    std::string lacking;
    if (options.files.empty()) {
        live.emplace(options.network).waitForAll();
        live->printWarnings();
        lacking = live->incomplete();
        if (options.json && !lacking.empty()) throw Failure{NotFound, lacking};
    }
    const Graph graph = live ? graphOf(*live) : graphOf(options);
    if (options.json) {
        print(graphJson(graph));
    } else if (options.dot) {
        printDot(std::cout, graph);
    } else {
        printGraph(std::cout, graph);
    }
    if (!lacking.empty()) throw Failure{NotFound, lacking};
    return Yes;
}

}  // namespace cortex::cli
