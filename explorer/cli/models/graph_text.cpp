// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/value.hpp"

#include "models/graph.hpp"

#include <algorithm>
#include <span>

namespace cortex::cli {
namespace {

// "/arm/axes/" and 3 for "/arm/axes/3".
struct Numbered {
    std::string stem;
    std::int64_t number = 0;
};

std::optional<Numbered> numbered(const std::string& path) {
    const std::size_t slash = path.rfind('/') + 1;
    const auto number = toInt(std::string_view{path}.substr(slash));
    if (!number || toText(*number) != path.substr(slash)) return std::nullopt;
    return Numbered{path.substr(0, slash), *number};
}

// Paths that count upwards are joined: /arm/axes/1..7.
std::vector<std::string> shortened(const std::vector<std::string>& paths) {
    std::vector<std::string> result;
    for (std::size_t first = 0; first < paths.size();) {
        const auto begin = numbered(paths[first]);
        std::size_t last = first;
        while (begin && last + 1 < paths.size()) {
            const auto next = numbered(paths[last + 1]);
            const auto wanted = begin->number + static_cast<std::int64_t>(last + 1 - first);
            if (!next || next->stem != begin->stem || next->number != wanted) break;
            ++last;
        }
        const bool run = last > first;
        result.push_back(run ? paths[first] + ".." + toText(numbered(paths[last])->number)
                             : paths[first]);
        first = last + 1;
    }
    return result;
}

class GraphPrinter {
public:
    GraphPrinter(std::ostream& stream, const Graph& graph)
        : stream_{stream},
          graph_{graph},
          structure_{*graph.structure},
          several_{graph.severalAgents()} {}

    void run() {
        stream_ << "system " << printable(graph_.title) << ": "
                << plural(structure_.simplexes.size(), "simplex") << ", "
                << plural(structure_.edges.size(), "relationship") << '\n';
        printLevels();
        printRelationships();
        printData();
    }

private:
    const SimplexInfo& info(std::uint32_t simplex) const { return structure_.simplexes[simplex]; }

    void printLevels() {
        Columns columns{2};
        for (std::size_t level = 0; level < graph_.levels.size(); ++level) {
            std::string number = std::to_string(level + 1);
            for (const std::uint32_t simplex : graph_.levels[level]) {
                const std::uint32_t every = info(simplex).every;
                columns.add({number, info(simplex).path, info(simplex).layout->type->name,
                             several_ ? graph_.agentText(simplex) : "",
                             every > 1 ? "every " + std::to_string(every) + " cycles" : ""});
                number.clear();
            }
        }
        if (graph_.levels.empty()) return;
        stream_ << "\norder of execution: each level waits for those above it, within a level any "
                   "order\n";
        columns.print(stream_);
    }

    void printRelationships() {
        if (!structure_.edges.empty()) {
            stream_ << "\nrelationships: <- takes from, -> gives to; delayed: one cycle later, "
                       "without order\n";
        }
        for (const SimplexInfo& owner : structure_.simplexes) {
            if (owner.edgeCount == 0) continue;
            stream_ << "  " << printable(owner.path) << '\n';
            printRules(std::span{structure_.edges}.subspan(owner.firstEdge, owner.edgeCount));
        }
    }

    void printRules(std::span<const Edge> edges) {
        Columns columns{4};
        for (std::size_t i = 0; i < edges.size();) {
            const Edge& first = edges[i];
            std::vector<std::string> targets;
            const std::string where = elsewhere(first);
            for (; i < edges.size() && edges[i].rule == first.rule &&
                   edges[i].delayed == first.delayed && elsewhere(edges[i]) == where;
                 ++i) {
                targets.push_back(info(edges[i].target).path);
            }
            const bool input = first.rule->direction == Direction::Input;
            columns.add({first.rule->name, (input ? "<- " : "-> ") + joined(shortened(targets)) +
                                               where + (first.delayed ? " (delayed)" : "")});
        }
        columns.print(stream_);
    }

    // What is said of a target that does not belong to the agent of its owner.
    std::string elsewhere(const Edge& edge) const {
        if (graph_.agentOf[edge.owner] == graph_.agentOf[edge.target]) return "";
        if (info(edge.target).remote) return several_ ? " (no agent)" : " (another agent)";
        return " (" + graph_.agentText(edge.target) + ")";
    }

    // Everything without a task: its role and its writer.
    void printData() {
        Columns columns{2};
        bool any = false;
        for (std::uint32_t i = 0; i < structure_.simplexes.size(); ++i) {
            if (graph_.levelOf[i] > 0) continue;
            std::vector<std::string> writers;
            for (const std::uint32_t writer : info(i).writers) writers.push_back(info(writer).path);
            columns.add({info(i).path, info(i).layout->type->name, roleOf(info(i)),
                         several_ ? graph_.agentText(i) : "",
                         writers.empty() ? "" : "written by " + joined(writers)});
            any = true;
        }
        if (any) stream_ << "\nwithout a task\n";
        columns.print(stream_);
    }

    static std::string roleOf(const SimplexInfo& info) {
        if (info.remote) return "of another agent";
        return info.role == Role::Active ? "the agent itself" : name(info.role);
    }

    std::ostream& stream_;
    const Graph& graph_;
    const Structure& structure_;
    const bool several_;  // agents: each simplex says its own
};

}  // namespace

void printGraph(std::ostream& stream, const Graph& graph) { GraphPrinter{stream, graph}.run(); }

}  // namespace cortex::cli
