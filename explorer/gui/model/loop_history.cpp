// SPDX-License-Identifier: Apache-2.0
#include "model/loop_history.hpp"

#include "model/item_of.hpp"
#include "model/loop_metrics.hpp"

#include <algorithm>

namespace cortex::gui {

namespace {

constexpr double between = 0.25, soonest = 1, minute = 60;  // s

constexpr std::array<const char*, counterCount> counterItems{
    "overflowCount", "commandCount",  "rejectedCount", "conflictCount",
    "limitCount",    "eventsDropped", nullptr};

LoopHistory::Moment momentOf(const Frame& frame, const AgentFrame& agent) {
    LoopHistory::Moment moment{frame.seconds, {}, {}, {}};
    for (std::size_t i = 0; i < counterCount; ++i) {
        moment.counts[i] = countOf(agent, static_cast<Counter>(i));
    }
    const LoopMetrics loop = loopMetrics(agent);
    if (!loop.live) return moment;
    moment.duty = loop.duty.numbers[LoopFigure::Last];
    moment.jitter = loop.times[LoopMetrics::Jitter].numbers[LoopFigure::P99];
    return moment;
}

}  // namespace

const char* itemOf(Counter counter) { return counterItems[static_cast<std::size_t>(counter)]; }

std::optional<std::int64_t> countOf(const AgentFrame& agent, Counter counter) {
    if (counter == Counter::Loss) return static_cast<std::int64_t>(agent.status.loss);
    const std::uint32_t own = agent.own();
    if (own == noSimplex || !agent.came(own)) return std::nullopt;
    return itemOf<std::int64_t>(agent, own, itemOf(counter));
}

void LoopHistory::add(const Frame& frame) {
    std::erase_if(seen_, [&](const auto& each) {
        return std::ranges::none_of(
            frame.agents, [&](const AgentFrame& agent) { return agent.status.name == each.first; });
    });
    for (const AgentFrame& agent : frame.agents) {
        auto& [epoch, moments] = seen_[agent.status.name];
        const bool back = !moments.empty() && frame.seconds < moments.back().time;
        if (epoch != agent.status.epoch || back) moments.clear();
        epoch = agent.status.epoch;
        if (!moments.empty() && frame.seconds - moments.back().time < between) continue;
        moments.push_back(momentOf(frame, agent));
        while (frame.seconds - moments.front().time > span) moments.pop_front();
    }
}

std::optional<LoopHistory::Change> LoopHistory::change(const AgentFrame& agent,
                                                       Counter counter) const {
    const auto& moments = of(agent);
    const auto index = static_cast<std::size_t>(counter);
    if (moments.empty() || !moments.back().counts[index]) return std::nullopt;
    const Moment& last = moments.back();
    const auto first = std::ranges::find_if(moments, [&](const Moment& each) {
        return each.counts[index] && last.time - each.time <= minute;
    });
    const double seconds = last.time - first->time;
    if (seconds < soonest) return std::nullopt;
    const auto more = static_cast<std::uint64_t>(*last.counts[index]) -
                      static_cast<std::uint64_t>(*first->counts[index]);  // whatever an agent says
    return Change{static_cast<std::int64_t>(more), seconds};
}

const std::deque<LoopHistory::Moment>& LoopHistory::of(const AgentFrame& agent) const {
    static const std::deque<Moment> nothing;
    const auto seen = seen_.find(agent.status.name);
    const bool known = seen != seen_.end() && seen->second.epoch == agent.status.epoch;
    return known ? seen->second.moments : nothing;
}

}  // namespace cortex::gui
