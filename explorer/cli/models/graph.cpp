// SPDX-License-Identifier: Apache-2.0
#include "models/graph.hpp"

#include <algorithm>
#include <utility>

namespace cortex::cli {
namespace {

// First to second; what is delayed or belongs to another agent orders nothing.
std::vector<std::pair<std::uint32_t, std::uint32_t>> ordersOf(
    const Structure& structure, const std::vector<std::string>& agents) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> orders;
    for (const Edge& edge : structure.edges) {
        if (edge.delayed || structure.simplexes[edge.target].remote) continue;
        if (agents[edge.owner] != agents[edge.target]) continue;
        const bool input = edge.rule->direction == Direction::Input;
        orders.emplace_back(input ? edge.target : edge.owner, input ? edge.owner : edge.target);
    }
    return orders;
}

bool hasTask(const SimplexInfo& info) {
    return info.role == Role::Active && !info.remote && !info.layout->type->isA("Agent");
}

}  // namespace

bool Graph::severalAgents() const {
    std::set<std::string> agents{agentOf.begin(), agentOf.end()};
    agents.erase("");
    return agents.size() > 1;
}

std::string Graph::agentText(std::uint32_t simplex) const {
    const std::string& agent = agentOf[simplex];
    if (agent.empty()) return "no agent";
    return lost.contains(agent) ? agent + ", lost" : agent;
}

Graph makeGraph(std::string title, const std::shared_ptr<const Structure>& structure,
                std::vector<std::string> agents, std::set<std::string> lost) {
    const std::size_t count = structure->simplexes.size();
    std::vector<std::vector<std::uint32_t>> after(count);
    std::vector<std::uint32_t> waiting(count), depth(count), ready;
    for (const auto& [first, second] : ordersOf(*structure, agents)) {
        after[first].push_back(second);
        ++waiting[second];
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        if (waiting[i] == 0) ready.push_back(i);
    }
    Graph graph{std::move(title),  structure,      {}, std::vector<std::uint32_t>(count),
                std::move(agents), std::move(lost)};
    for (std::size_t next = 0; next < ready.size(); ++next) {
        const std::uint32_t simplex = ready[next];
        if (hasTask(structure->simplexes[simplex])) graph.levelOf[simplex] = ++depth[simplex];
        for (const std::uint32_t other : after[simplex]) {
            depth[other] = std::max(depth[other], depth[simplex]);
            if (--waiting[other] == 0) ready.push_back(other);
        }
    }
    const auto levels = std::ranges::max_element(graph.levelOf);
    graph.levels.resize(count > 0 ? *levels : 0);
    for (std::uint32_t i = 0; i < count; ++i) {
        if (graph.levelOf[i] > 0) graph.levels[graph.levelOf[i] - 1].push_back(i);
    }
    return graph;
}

Json graphJson(const Graph& graph) {
    const Structure& structure = *graph.structure;
    const auto path = [&](std::uint32_t simplex) { return structure.simplexes[simplex].path; };
    Json levels = Json::array(), simplexes = Json::array(), relationships = Json::array();
    for (const auto& level : graph.levels) {
        Json paths = Json::array();
        for (const std::uint32_t simplex : level) paths.push_back(path(simplex));
        levels.push_back(paths);
    }
    for (std::uint32_t i = 0; i < structure.simplexes.size(); ++i) {
        const SimplexInfo& info = structure.simplexes[i];
        Json writers = Json::array();
        for (const std::uint32_t writer : info.writers) writers.push_back(path(writer));
        simplexes.push_back({{"path", info.path},
                             {"type", info.layout->type->name},
                             {"role", name(info.role)},
                             {"remote", info.remote},
                             {"agent", graph.agentOf[i].empty() ? Json() : Json(graph.agentOf[i])},
                             {"lost", graph.lost.contains(graph.agentOf[i])},
                             {"level", graph.levelOf[i] > 0 ? Json(graph.levelOf[i]) : Json()},
                             {"every", info.every},
                             {"writers", writers}});
    }
    for (const Edge& edge : structure.edges) {
        relationships.push_back({{"owner", path(edge.owner)},
                                 {"rule", edge.rule->name},
                                 {"direction", name(edge.rule->direction)},
                                 {"to", path(edge.target)},
                                 {"delayed", edge.delayed}});
    }
    return {{"system", graph.title},
            {"levels", levels},
            {"simplexes", simplexes},
            {"relationships", relationships}};
}

}  // namespace cortex::cli
