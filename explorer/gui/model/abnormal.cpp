// SPDX-License-Identifier: Apache-2.0
#include "model/abnormal.hpp"

#include "model/condition.hpp"

#include <algorithm>

namespace cortex::gui {

namespace {

constexpr int framesBetweenLooks = 5;  // states and qualities six times a second
constexpr int looksBetweenLimits = 3;  // limits, of which there are many more, twice

template <class Visit>
void forOwnSimplexes(const AgentFrame& agent, Visit visit) {
    if (!agent.structure) return;
    const auto& simplexes = agent.structure->simplexes;
    for (std::uint32_t i = 0; i < simplexes.size(); ++i) {
        if (!simplexes[i].remote) visit(i);
    }
}

// What comes is counted at once: none says "0 faults" of what it has not heard yet, nor what is
// wrong in an agent that is lost by now.
std::size_t howManyCame(const Frame& frame) {
    std::size_t come = 0;
    for (const AgentFrame& agent : frame.agents) {
        if (agent.lost()) continue;
        forOwnSimplexes(agent, [&](std::uint32_t simplex) { come += agent.came(simplex) ? 1 : 0; });
    }
    return come;
}

// The simplex that stands for a lost agent: its own, otherwise its first.
std::uint32_t standsFor(const AgentFrame& agent) {
    const std::uint32_t own = agent.structure->find('/' + agent.status.name);
    return own == noSimplex ? 0 : own;
}

}  // namespace

void Abnormal::add(Kind kind, const AgentFrame& agent, Place place) {
    ++counts_[kind];
    if (kind == Lost && agent.lost() && place.simplex != standsFor(agent)) return;
    found_[kind].push_back({agent.structure->simplexes[place.simplex].path, place});
}

void Abnormal::findOutside(const AgentFrame& agent, std::uint32_t index) {
    forOwnSimplexes(agent, [&](std::uint32_t simplex) {
        if (isOutside(agent, simplex)) add(Outside, agent, {index, simplex});
    });
}

void Abnormal::update(const Frame& frame) {
    const std::size_t come = howManyCame(frame);
    const bool changed = frame.structures != structures_ || come != come_;
    if (!changed && frames_++ % framesBetweenLooks != 0) return;
    const bool limits = changed || looks_++ % looksBetweenLimits == 0;
    structures_ = frame.structures;
    come_ = come;
    ++looked_;
    for (const Kind kind : {Fault, Outside, Lost}) {
        if (kind == Outside && !limits) continue;
        counts_[kind] = 0;
        found_[kind].clear();
    }
    for (std::uint32_t i = 0; i < frame.agents.size(); ++i) {
        const AgentFrame& agent = frame.agents[i];
        if (agent.status.ended) continue;
        forOwnSimplexes(agent, [&](std::uint32_t simplex) {
            if (agent.state(simplex) == State::Fault) add(Fault, agent, {i, simplex});
            const bool lost = agent.came(simplex) && agent.quality(simplex) == Quality::Lost &&
                              frame.excuse({i, simplex}) == Excuse::None;
            if (agent.lost() || lost) add(Lost, agent, {i, simplex});
        });
        if (limits) findOutside(agent, i);
    }
}

std::string Abnormal::next(const std::string& path, bool back, std::optional<Kind> kind) const {
    std::vector<std::string> all;
    for (const Kind each : {Fault, Outside, Lost}) {
        if (kind && each != *kind) continue;
        for (const Found& found : found_[each]) {
            if (std::ranges::find(all, found.path) == all.end()) all.push_back(found.path);
        }
    }
    if (all.empty()) return {};
    if (back) std::ranges::reverse(all);
    const auto here = std::ranges::find(all, path);
    const bool last = here == all.end() || here + 1 == all.end();
    return last ? all.front() : *(here + 1);
}

}  // namespace cortex::gui
