// SPDX-License-Identifier: Apache-2.0
#include "model/relationship_order.hpp"

#include <algorithm>

namespace cortex {
namespace {

// Depth-first search without recursion: a chain of simplexes may be long.
class LoopSearch {
public:
    LoopSearch(const Structure& structure, std::size_t most)
        : structure_{structure},
          most_{most},
          leaving_(structure.simplexes.size()),
          marks_(structure.simplexes.size(), Mark::New) {
        for (std::uint32_t edge = 0; edge < structure.edges.size(); ++edge) {
            const Edge& each = structure.edges[edge];
            if (orders(structure, each)) leaving_[orderOf(each).first].push_back(edge);
        }
    }

    std::vector<Loop> run() {
        for (std::uint32_t simplex = 0; simplex < marks_.size(); ++simplex) {
            if (marks_[simplex] == Mark::New) searchFrom(simplex);
        }
        return std::move(loops_);
    }

private:
    enum class Mark : std::uint8_t { New, OnPath, Done };
    struct Step {
        std::uint32_t simplex;
        std::size_t next = 0;  // edge to follow
    };

    void searchFrom(std::uint32_t start) {
        path_.push_back({start});
        marks_[start] = Mark::OnPath;
        while (!path_.empty() && loops_.size() < most_) {
            Step& step = path_.back();
            if (step.next == leaving_[step.simplex].size()) {
                marks_[step.simplex] = Mark::Done;
                path_.pop_back();
                continue;
            }
            follow(leaving_[step.simplex][step.next++]);
        }
    }

    void follow(std::uint32_t edge) {
        const std::uint32_t to = orderOf(structure_.edges[edge]).second;
        if (marks_[to] == Mark::OnPath) {
            addLoop(to);
        } else if (marks_[to] == Mark::New) {
            marks_[to] = Mark::OnPath;
            path_.push_back({to});
        }
    }

    // The edges last followed from `to` on close the loop.
    void addLoop(std::uint32_t to) {
        const auto start = std::ranges::find(path_, to, &Step::simplex);
        Loop loop;
        for (auto step = start; step != path_.end(); ++step) {
            loop.push_back(leaving_[step->simplex][step->next - 1]);
        }
        const auto first = std::ranges::min_element(
            loop, {}, [&](std::uint32_t edge) { return orderOf(structure_.edges[edge]).first; });
        std::ranges::rotate(loop, first);
        loops_.push_back(std::move(loop));
    }

    const Structure& structure_;
    std::size_t most_;
    std::vector<std::vector<std::uint32_t>> leaving_;
    std::vector<Mark> marks_;
    std::vector<Step> path_;
    std::vector<Loop> loops_;
};

}  // namespace

bool orders(const Structure& structure, const Edge& edge) {
    return !edge.delayed && !structure.simplexes[edge.target].remote;
}

std::pair<std::uint32_t, std::uint32_t> orderOf(const Edge& edge) {
    return edge.rule->direction == Direction::Input ? std::pair{edge.target, edge.owner}
                                                    : std::pair{edge.owner, edge.target};
}

std::vector<Loop> findLoops(const Structure& structure, std::size_t most) {
    return LoopSearch{structure, most}.run();
}

}  // namespace cortex
