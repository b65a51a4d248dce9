// SPDX-License-Identifier: Apache-2.0
#include "models/graph.hpp"

namespace cortex::cli {
namespace {

// A quoted string of the DOT language; backslashes would begin escapes of Graphviz.
std::string dotString(std::string_view text) {
    std::string result = "\"";
    for (const char c : printable(text)) {
        if (c == '"' || c == '\\') result += '\\';
        result += c;
    }
    return result + '"';
}

std::string label(const std::string& first, const std::string& second) {
    std::string text = dotString(first);
    text.pop_back();
    return text + "\\n" + dotString(second).substr(1);
}

const char* look(const SimplexInfo& info, bool lost) {
    if (info.remote || lost) return "shape=ellipse style=dashed";
    switch (info.role) {
        case Role::Active:
            return "shape=box style=filled fillcolor=\"#cfe2f3\"";
        case Role::Modification:
            return "shape=ellipse style=filled fillcolor=\"#fce5cd\"";
        case Role::Observation:
            return "shape=ellipse style=filled fillcolor=\"#d9ead3\"";
        case Role::Descriptive:
            break;
    }
    return "shape=ellipse";
}

}  // namespace

void printDot(std::ostream& stream, const Graph& graph) {
    const Structure& structure = *graph.structure;
    stream
        << "// boxes: active; orange: modifications; green: observations; dashed edges: delayed\n"
        << "digraph " << dotString(graph.title) << " {\n  rankdir=LR;\n"
        << "  node [fontname=\"sans-serif\" fontsize=10];\n"
        << "  edge [fontname=\"sans-serif\" fontsize=8];\n";
    const bool several = graph.severalAgents();
    for (std::uint32_t i = 0; i < structure.simplexes.size(); ++i) {
        const SimplexInfo& info = structure.simplexes[i];
        const std::string agent = several ? " (" + graph.agentText(i) + ")" : "";
        stream << "  " << dotString(info.path)
               << " [label=" << label(info.path, info.layout->type->name + agent) << ' '
               << look(info, graph.lost.contains(graph.agentOf[i])) << "];\n";
    }
    for (const Edge& edge : structure.edges) {
        const bool input = edge.rule->direction == Direction::Input;
        const std::string& owner = structure.simplexes[edge.owner].path;
        const std::string& target = structure.simplexes[edge.target].path;
        stream << "  " << dotString(input ? target : owner) << " -> "
               << dotString(input ? owner : target) << " [label=" << dotString(edge.rule->name)
               << (edge.delayed ? " style=dashed constraint=false" : "") << "];\n";
    }
    stream << "}\n";
}

}  // namespace cortex::cli
