// SPDX-License-Identifier: Apache-2.0
#include "model/start_order.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace cortex::gui {

namespace {

// Simplexes of all agents by one number, and what each of them relies on directly.
class Graph {
public:
    explicit Graph(const Frame& frame) : frame_{frame} {
        for (const AgentFrame& agent : frame.agents) {
            first_.push_back(count_);
            if (agent.structure) count_ += agent.structure->simplexes.size();
        }
        before_.resize(count_);
        for (std::uint32_t agent = 0; agent < frame.agents.size(); ++agent) addEdges(agent);
    }

    struct Before {
        std::size_t node = 0;
        bool crosses = false;  // from one agent to another
    };
    std::size_t count() const { return count_; }
    std::size_t node(Place place) const { return first_[place.agent] + place.simplex; }
    const std::vector<Before>& before(std::size_t node) const { return before_[node]; }
    std::optional<std::size_t> find(const SimplexOf& wanted) const {
        for (std::uint32_t agent = 0; agent < frame_.agents.size(); ++agent) {
            const AgentFrame& each = frame_.agents[agent];
            if (each.status.name != wanted.agent || !each.structure) continue;
            const std::uint32_t simplex = each.structure->find(wanted.path);
            if (simplex != noSimplex) return node({agent, simplex});
        }
        return std::nullopt;
    }
    bool isActive(std::size_t node) const {
        const auto above = std::ranges::upper_bound(first_, node);
        const auto agent = static_cast<std::size_t>(above - first_.begin()) - 1;
        const auto simplex = static_cast<std::uint32_t>(node - first_[agent]);
        return frame_.agents[agent].state(simplex) == State::Active;
    }

private:
    // The same relationships as those that order the tasks of a cycle.
    void addEdges(std::uint32_t agent) {
        if (!frame_.agents[agent].structure) return;
        const Structure& structure = *frame_.agents[agent].structure;
        for (const Edge& edge : structure.edges) {
            if (edge.owner == noSimplex || edge.target == noSimplex) continue;
            Place target{agent, edge.target};
            if (structure.simplexes[edge.target].remote) {
                const auto found = frame_.find(structure.simplexes[edge.target].path);
                if (!found) continue;
                target = *found;
            }
            const SimplexInfo& info = frame_.info(target);
            const bool writes = edge.rule->direction == Direction::Output;
            const bool joins = writes && info.writers.size() > 1;
            if ((edge.delayed && !joins) || (!writes && info.delayedOutput)) continue;
            const std::size_t owner = node({agent, edge.owner}), other = node(target);
            const bool crosses = target.agent != agent;
            before_[writes ? other : owner].push_back({writes ? owner : other, crosses});
        }
    }

    const Frame& frame_;
    std::size_t count_ = 0;
    std::vector<std::size_t> first_;  // by agent
    std::vector<std::vector<Before>> before_;
};

// Whom each one relies on: those of them that are met first, along its relationships.
class Search {
public:
    Search(const Graph& graph, const std::vector<SimplexOf>& all)
        : graph_{graph}, placeOf_(graph.count(), none), seen_(graph.count(), none) {
        for (std::size_t place = 0; place < all.size(); ++place) {
            nodes_.push_back(graph.find(all[place]));
            if (nodes_.back()) placeOf_[*nodes_.back()] = place;
        }
    }
    std::vector<std::size_t> from(std::size_t place, bool across) {
        std::vector<std::size_t> found;
        if (!nodes_[place]) return found;
        ++round_;
        std::vector<std::size_t> open{*nodes_[place]};
        seen_[open.front()] = round_;
        while (!open.empty()) {
            const std::size_t node = open.back();
            open.pop_back();
            for (const Graph::Before& each : graph_.before(node)) {
                if (each.crosses && !across) continue;
                if (std::exchange(seen_[each.node], round_) == round_) continue;
                if (placeOf_[each.node] != none)
                    found.push_back(placeOf_[each.node]);
                else if (!graph_.isActive(each.node))
                    open.push_back(each.node);
            }
        }
        return found;
    }

private:
    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    const Graph& graph_;
    std::vector<std::optional<std::size_t>> nodes_;
    std::vector<std::size_t> placeOf_, seen_;
    std::size_t round_ = 0;
};

// Whether the one relies on the other, also through others of them.
bool reaches(const StartOrder& order, std::size_t from, std::size_t to) {
    std::vector<bool> seen(order.size());
    std::vector<std::size_t> open{from};
    while (!open.empty()) {
        const std::size_t place = open.back();
        open.pop_back();
        if (place == to) return true;
        if (seen[place]) continue;
        seen[place] = true;
        open.insert(open.end(), order[place].begin(), order[place].end());
    }
    return false;
}

}  // namespace

StartOrder startOrder(const Frame& frame, const std::vector<SimplexOf>& all) {
    const Graph graph{frame};
    Search search{graph, all};
    StartOrder within, across;
    for (std::size_t place = 0; place < all.size(); ++place) {
        within.push_back(search.from(place, false));
        across.push_back(search.from(place, true));
    }
    // An agent alone has no circle: it would not have started.
    StartOrder order = within;
    for (std::size_t place = 0; place < all.size(); ++place) {
        for (const std::size_t each : across[place]) {
            const bool known = std::ranges::find(within[place], each) != within[place].end();
            if (!known && !reaches(across, each, place)) order[place].push_back(each);
        }
    }
    return order;
}

std::vector<std::size_t> mayStart(const StartOrder& order, const std::vector<StartStep>& steps) {
    std::vector<std::size_t> now;
    for (std::size_t place = 0; place < order.size(); ++place) {
        const bool waits = steps[place] == StartStep::Waits;
        const bool may = std::ranges::all_of(order[place], [&](std::size_t each) {
            return steps[each] == StartStep::Active || steps[each] == StartStep::Left;
        });
        if (waits && may) now.push_back(place);
    }
    return now;
}

}  // namespace cortex::gui
