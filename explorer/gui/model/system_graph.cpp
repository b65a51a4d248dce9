// SPDX-License-Identifier: Apache-2.0
#include "model/system_graph.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace cortex::gui {

namespace {

// A relationship by paths, so that it joins simplexes of two agents as well.
struct Flow {
    std::string from, to, rule;
    bool delayed = false;
};

struct Found {
    std::string type, parent;     // the first of its parents; its own name without one
    std::set<std::string> alike;  // its relationships, without the numbers in paths
};

std::string parentOf(const std::string& path) { return path.substr(0, path.rfind('/')); }

bool isNumbered(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    return slash != std::string::npos && slash + 1 < path.size() &&
           std::all_of(path.begin() + static_cast<std::ptrdiff_t>(slash) + 1, path.end(),
                       [](char c) { return c >= '0' && c <= '9'; });
}

std::string withoutNumber(const std::string& path) {
    return isNumbered(path) ? parentOf(path) + "/*" : path;
}

std::vector<Flow> flowsOf(const Frame& frame) {
    std::vector<Flow> flows;
    for (const AgentFrame& agent : frame.agents) {
        if (!agent.structure) continue;
        const Structure& structure = *agent.structure;
        for (const Edge& edge : structure.edges) {
            if (edge.target == noSimplex) continue;
            const std::string& owner = structure.simplexes[edge.owner].path;
            const std::string& target = structure.simplexes[edge.target].path;
            const bool input = edge.rule->direction == Direction::Input;
            flows.push_back(
                {input ? target : owner, input ? owner : target, edge.rule->name, edge.delayed});
        }
    }
    return flows;
}

std::map<std::string, Found> simplexesOf(const Frame& frame) {
    std::map<std::string, Found> simplexes;
    for (const AgentFrame& agent : frame.agents) {
        if (!agent.structure) continue;
        for (const SimplexInfo& info : agent.structure->simplexes) {
            const Type& type = *info.layout->type;
            Found& found = simplexes[info.path];
            found.type = type.name;
            found.parent = type.parents.empty() ? type.name : type.parents.front();
        }
    }
    return simplexes;
}

}  // namespace

std::uint32_t SystemGraph::find(const std::string& path) const {
    const auto found = std::ranges::find_if(
        nodes, [&](const GraphNode& node) { return std::ranges::count(node.paths, path) > 0; });
    return found == nodes.end() ? noSimplex : static_cast<std::uint32_t>(found - nodes.begin());
}

SystemGraph makeSystemGraph(const Frame& frame, const std::set<std::string>& open) {
    auto simplexes = simplexesOf(frame);
    const std::vector<Flow> flows = flowsOf(frame);
    for (const Flow& flow : flows) {
        simplexes[flow.from].alike.insert("to " + withoutNumber(flow.to) + " " + flow.rule);
        simplexes[flow.to].alike.insert("from " + withoutNumber(flow.from) + " " + flow.rule);
    }

    SystemGraph graph;
    using Family = std::tuple<std::string, std::string, std::set<std::string>>;
    std::map<Family, std::vector<std::string>> families;
    std::map<std::string, std::uint32_t> nodeOf;
    for (const auto& [path, found] : simplexes) {
        if (found.alike.empty())
            ++graph.unrelated;
        else if (isNumbered(path) && !open.contains(withoutNumber(path)))
            families[{parentOf(path), found.parent, found.alike}].push_back(path);
        else
            graph.nodes.push_back({path, found.type, {path}});
    }
    for (auto& [family, paths] : families) {
        const std::string key = paths.size() > 1 ? std::get<0>(family) + "/*" : paths.front();
        const std::string& first = simplexes.at(paths.front()).type;
        const bool same = std::ranges::all_of(
            paths, [&](const std::string& path) { return simplexes.at(path).type == first; });
        graph.nodes.push_back({key, same ? first : std::get<1>(family), std::move(paths)});
    }
    std::ranges::sort(graph.nodes, {}, [](const GraphNode& node) { return node.paths.front(); });
    for (std::uint32_t i = 0; i < graph.nodes.size(); ++i) {
        for (const std::string& path : graph.nodes[i].paths) nodeOf[path] = i;
    }

    std::map<std::tuple<std::uint32_t, std::uint32_t, bool>, std::set<std::string>> edges;
    for (const Flow& flow : flows) {
        edges[{nodeOf.at(flow.from), nodeOf.at(flow.to), flow.delayed}].insert(flow.rule);
    }
    for (const auto& [ends, rules] : edges) {
        const auto& [from, to, delayed] = ends;
        graph.edges.push_back({from, to, {rules.begin(), rules.end()}, delayed});
    }
    return graph;
}

}  // namespace cortex::gui
