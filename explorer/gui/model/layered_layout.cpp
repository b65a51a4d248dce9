// SPDX-License-Identifier: Apache-2.0
#include "model/layered_layout.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace cortex::gui {

namespace {

constexpr int sweeps = 12;
constexpr int straightenings = 8;
constexpr double lineGap = 0.4;                 // rows between two edges that pass a layer
constexpr std::size_t mostToTranspose = 2'000;  // nodes; above it, medians alone

using Nodes = std::vector<std::uint32_t>;

// The nodes of one component, and one more node in each layer that an edge passes.
struct Levels {
    std::vector<Nodes> layers;
    std::vector<Nodes> before, after;  // neighbours in the layers to the left and right
    std::vector<double> place;         // of each node within its layer
    std::size_t nodes = 0;             // the nodes that follow are where edges pass
};

// Marks the edges that would close a loop, so that the others order the nodes.
class Loops {
public:
    Loops(std::size_t nodes, std::span<const LayoutEdge> edges, std::vector<bool>& back)
        : edges_{edges}, back_{back}, out_(nodes), seen_(nodes, Seen::No) {
        for (std::uint32_t i = 0; i < edges.size(); ++i) {
            if (!back[i]) out_[edges[i].from].push_back(i);
        }
    }
    void cut() {
        for (std::uint32_t i = 0; i < out_.size(); ++i) {
            if (seen_[i] == Seen::No) visit(i);
        }
    }

private:
    enum class Seen : std::uint8_t { No, Open, Done };

    // Depth first with a stack of its own: a chain may have many thousand nodes.
    void visit(std::uint32_t first) {
        std::vector<std::pair<std::uint32_t, std::size_t>> open{{first, 0}};
        seen_[first] = Seen::Open;
        while (!open.empty()) {
            auto& [node, next] = open.back();
            if (next == out_[node].size()) {
                seen_[node] = Seen::Done;
                open.pop_back();
                continue;
            }
            const std::uint32_t edge = out_[node][next++];
            const std::uint32_t target = edges_[edge].to;
            if (seen_[target] == Seen::Open) back_[edge] = true;
            if (seen_[target] != Seen::No) continue;
            seen_[target] = Seen::Open;
            open.emplace_back(target, 0);
        }
    }

    std::span<const LayoutEdge> edges_;
    std::vector<bool>& back_;
    std::vector<Nodes> out_;
    std::vector<Seen> seen_;
};

// The layer of each node: behind all that it waits for; what waits for nothing stands close to who
// waits for it.
std::vector<int> layersOf(std::size_t nodes, std::span<const LayoutEdge> edges,
                          const std::vector<bool>& back) {
    std::vector<Nodes> out(nodes);
    std::vector<int> waits(nodes), layer(nodes);
    for (std::size_t i = 0; i < edges.size(); ++i) {
        if (back[i]) continue;
        out[edges[i].from].push_back(edges[i].to);
        ++waits[edges[i].to];
    }
    Nodes order;
    for (std::uint32_t i = 0; i < nodes; ++i) {
        if (waits[i] == 0) order.push_back(i);
    }
    const std::size_t first = order.size();
    for (std::size_t i = 0; i < order.size(); ++i) {
        for (const std::uint32_t next : out[order[i]]) {
            layer[next] = std::max(layer[next], layer[order[i]] + 1);
            if (--waits[next] == 0) order.push_back(next);
        }
    }
    for (std::size_t i = 0; i < first; ++i) {
        const Nodes& next = out[order[i]];
        if (next.empty()) continue;
        const auto least =
            std::ranges::min_element(next, {}, [&](std::uint32_t each) { return layer[each]; });
        layer[order[i]] = layer[*least] - 1;
    }
    return layer;
}

Nodes componentsOf(std::size_t nodes, std::span<const LayoutEdge> edges) {
    Nodes root(nodes);
    std::iota(root.begin(), root.end(), 0U);
    const auto find = [&](std::uint32_t node) {
        while (root[node] != node) node = root[node] = root[root[node]];
        return node;
    };
    for (const LayoutEdge& edge : edges) root[find(edge.to)] = find(edge.from);
    for (std::uint32_t i = 0; i < nodes; ++i) root[i] = find(i);
    return root;
}

// Pairs of edges of two neighbouring nodes that cross when `left` stands above `right`.
int crossingsOf(const Nodes& left, const Nodes& right, const std::vector<double>& place) {
    int count = 0;
    for (const std::uint32_t a : left) {
        for (const std::uint32_t b : right) count += place[a] > place[b] ? 1 : 0;
    }
    return count;
}

int crossingsOf(const Levels& levels) {
    int count = 0;
    for (const Nodes& layer : levels.layers) {
        // The far ends of the edges by the place of their near ends: each inversion is a crossing.
        std::vector<double> ends;
        for (const std::uint32_t node : layer) {
            const std::size_t first = ends.size();
            for (const std::uint32_t next : levels.after[node]) {
                ends.push_back(levels.place[next]);
            }
            std::sort(ends.begin() + static_cast<std::ptrdiff_t>(first), ends.end());
        }
        std::vector<double> sorted;
        for (const double end : ends) {
            const auto at = std::ranges::upper_bound(sorted, end);
            count += static_cast<int>(sorted.end() - at);
            sorted.insert(at, end);
        }
    }
    return count;
}

void number(Levels& levels, const Nodes& layer) {
    for (std::size_t i = 0; i < layer.size(); ++i) levels.place[layer[i]] = static_cast<double>(i);
}

void sortByMedians(Levels& levels, Nodes& layer, const std::vector<Nodes>& neighbours) {
    std::vector<std::pair<double, std::uint32_t>> order;
    for (const std::uint32_t node : layer) {
        std::vector<double> places;
        for (const std::uint32_t each : neighbours[node]) places.push_back(levels.place[each]);
        std::ranges::sort(places);
        const std::size_t half = places.size() / 2;
        const double median = places.empty()          ? levels.place[node]
                              : places.size() % 2 > 0 ? places[half]
                                                      : (places[half - 1] + places[half]) / 2;
        order.emplace_back(median, node);
    }
    std::ranges::sort(order, [&](const auto& a, const auto& b) {
        return std::pair{a.first, levels.place[a.second]} <
               std::pair{b.first, levels.place[b.second]};
    });
    for (std::size_t i = 0; i < layer.size(); ++i) layer[i] = order[i].second;
    number(levels, layer);
}

// Exchanges neighbours within their layers as long as crossings go away.
void transpose(Levels& levels) {
    for (bool better = true; better;) {
        better = false;
        for (Nodes& layer : levels.layers) {
            for (std::size_t i = 1; i < layer.size(); ++i) {
                const std::uint32_t a = layer[i - 1], b = layer[i];
                const auto crossed = [&](std::uint32_t first, std::uint32_t second) {
                    return crossingsOf(levels.before[first], levels.before[second], levels.place) +
                           crossingsOf(levels.after[first], levels.after[second], levels.place);
                };
                if (crossed(b, a) >= crossed(a, b)) continue;
                std::swap(layer[i - 1], layer[i]);
                std::swap(levels.place[a], levels.place[b]);
                better = true;
            }
        }
    }
}

int order(Levels& levels) {
    for (const Nodes& layer : levels.layers) number(levels, layer);
    const bool small = levels.place.size() <= mostToTranspose;
    auto best = levels.layers;
    int least = crossingsOf(levels);
    for (int sweep = 0; sweep < sweeps && least > 0; ++sweep) {
        const std::size_t count = levels.layers.size();
        for (std::size_t i = 1; i < count; ++i) {
            const bool right = sweep % 2 == 0;
            sortByMedians(levels, levels.layers[right ? i : count - 1 - i],
                          right ? levels.before : levels.after);
        }
        if (small) transpose(levels);
        const int crossings = crossingsOf(levels);
        if (crossings >= least) continue;
        least = crossings;
        best = levels.layers;
    }
    levels.layers = std::move(best);
    for (const Nodes& layer : levels.layers) number(levels, layer);
    return least;
}

// Draws each node towards the middle of its neighbours; one row lies between two nodes of a layer.
void straighten(Levels& levels) {
    for (int i = 0; i < straightenings; ++i) {
        for (const Nodes& layer : levels.layers) {
            const auto half = [&](std::uint32_t node) {
                return node < levels.nodes ? 0.5 : lineGap / 2;
            };
            double above = -1e9, wanted = 0, got = 0;
            std::vector<double> goal;
            for (const std::uint32_t node : layer) {
                double sum = 0;
                int count = 0;
                for (const Nodes* side : {&levels.before[node], &levels.after[node]}) {
                    for (const std::uint32_t each : *side) sum += levels.place[each], ++count;
                }
                goal.push_back(count > 0 ? sum / count : levels.place[node]);
            }
            for (std::size_t k = 0; k < layer.size(); ++k) {
                above = std::max(goal[k], above + half(layer[k]));
                levels.place[layer[k]] = above;
                wanted += goal[k];
                got += above;
                above += half(layer[k]);
            }
            const double shift =
                layer.empty() ? 0 : (wanted - got) / static_cast<double>(layer.size());
            for (const std::uint32_t node : layer) levels.place[node] += shift;
        }
    }
    const double top = levels.place.empty() ? 0 : std::ranges::min(levels.place);
    for (double& place : levels.place) place -= top;
}

}  // namespace

LayeredLayout layered(std::size_t nodes, std::span<const LayoutEdge> edges) {
    LayeredLayout result;
    result.nodes.resize(nodes);
    result.bends.resize(edges.size());
    result.bottom.resize(edges.size());
    for (const LayoutEdge& edge : edges) result.back.push_back(edge.back || edge.from == edge.to);
    Loops{nodes, edges, result.back}.cut();
    const std::vector<int> layer = layersOf(nodes, edges, result.back);
    const auto component = componentsOf(nodes, edges);
    std::vector<Nodes> edgesOf(nodes), nodesOf(nodes);
    for (std::uint32_t i = 0; i < nodes; ++i) nodesOf[component[i]].push_back(i);
    for (std::uint32_t i = 0; i < edges.size(); ++i) {
        edgesOf[component[edges[i].from]].push_back(i);
    }
    Nodes roots;
    for (std::uint32_t i = 0; i < nodes; ++i) {
        if (!nodesOf[i].empty()) roots.push_back(i);
    }
    std::ranges::sort(roots, [&](std::uint32_t a, std::uint32_t b) {
        const std::size_t manyA = nodesOf[a].size(), manyB = nodesOf[b].size();
        return manyA != manyB ? manyA > manyB : nodesOf[a].front() < nodesOf[b].front();
    });
    Nodes local(nodes);  // the number of each node within its component
    for (const std::uint32_t root : roots) {
        Levels levels;
        const auto add = [&](int at) {
            const auto node = static_cast<std::uint32_t>(levels.before.size());
            const auto index = static_cast<std::size_t>(at);
            levels.layers.resize(std::max(levels.layers.size(), index + 1));
            levels.layers[index].push_back(node);
            levels.before.emplace_back();
            levels.after.emplace_back();
            return node;
        };
        for (const std::uint32_t node : nodesOf[root]) local[node] = add(layer[node]);
        levels.nodes = nodesOf[root].size();
        std::vector<std::pair<std::uint32_t, Nodes>> passed;
        for (const std::uint32_t edge : edgesOf[root]) {
            if (result.back[edge]) continue;
            const auto join = [&](std::uint32_t a, std::uint32_t b) {
                levels.after[a].push_back(b);
                levels.before[b].push_back(a);
            };
            Nodes bends;
            std::uint32_t last = local[edges[edge].from];
            for (int at = layer[edges[edge].from] + 1; at < layer[edges[edge].to]; ++at) {
                bends.push_back(add(at));
                join(last, bends.back());
                last = bends.back();
            }
            join(last, local[edges[edge].to]);
            passed.emplace_back(edge, std::move(bends));
        }
        levels.place.resize(levels.before.size());
        result.crossings += order(levels);
        straighten(levels);

        const double top = result.rows;
        double bottom = 0;
        for (const double place : levels.place) bottom = std::max(bottom, place);
        for (const std::uint32_t node : nodesOf[root]) {
            result.nodes[node] = {layer[node], top + levels.place[local[node]]};
        }
        for (const auto& [edge, bends] : passed) {
            int at = layer[edges[edge].from];
            for (const std::uint32_t bend : bends) {
                result.bends[edge].push_back({++at, top + levels.place[bend]});
            }
        }
        double backs = 0;
        for (const std::uint32_t edge : edgesOf[root]) {
            result.bottom[edge] = top + bottom;
            if (result.back[edge]) backs = 1;
        }
        result.rows = top + bottom + 1.5 + backs;
        result.layers = std::max(result.layers, static_cast<int>(levels.layers.size()));
    }
    return result;
}

}  // namespace cortex::gui
