// SPDX-License-Identifier: Apache-2.0
#include "session/lost_agents.hpp"

#include "session/utc_now.hpp"

#include <algorithm>

namespace cortex::gui {

namespace {

constexpr std::size_t mostKept = 1'000;

comms::AgentEvent eventOf(const AgentFrame& agent, Severity severity, std::string text) {
    comms::AgentEvent event;
    event.agent = agent.status.name;
    event.epoch = agent.status.epoch;
    event.cycle = agent.status.cycle;
    event.wallClock = utcNow();
    event.severity = severity;
    event.kind = name(EventKind::Loss);
    event.path = '/' + agent.status.name;
    event.text = std::move(text);
    return event;
}

}  // namespace

std::vector<comms::AgentEvent> LostAgents::update(std::vector<AgentFrame>& agents, Moment now) {
    std::vector<comms::AgentEvent> events;
    for (const AgentFrame& agent : agents) {
        if (!agent.lost())
            std::erase_if(dismissed_,
                          [&](const auto& each) { return each.first == agent.status.name; });
        tell(agent, events);
    }
    keep(agents, now);
    for (const AgentFrame& agent : agents) note(agent);
    std::erase_if(agents, [&](const AgentFrame& agent) {
        return agent.lost() && dismissed_.contains({agent.status.name, agent.status.epoch});
    });
    return events;
}

void LostAgents::note(const AgentFrame& agent) {
    const comms::AgentStatus& status = agent.status;
    const auto known = std::ranges::find(gone_, status.name, &GoneAgent::name);
    const bool dismissed = agent.lost() && dismissed_.contains({status.name, status.epoch});
    if (!status.ended && !dismissed) {
        if (!agent.lost() && known != gone_.end()) gone_.erase(known);
        return;
    }
    const bool same = known != gone_.end() && known->structure == agent.structure;
    if (same || !agent.structure) return;
    if (known != gone_.end()) gone_.erase(known);
    if (gone_.size() >= mostKept) gone_.erase(gone_.begin());
    const auto age = static_cast<std::int64_t>(status.age * 1e9);
    gone_.push_back({status.name, status.ended, utcNow() - age, agent.structure});
}

void LostAgents::tell(const AgentFrame& agent, std::vector<comms::AgentEvent>& events) const {
    const auto found = known_.find(agent.status.name);
    if (found == known_.end()) return;
    const AgentFrame& before = found->second.frame;
    if (before.status.epoch != agent.status.epoch) {
        events.push_back(eventOf(agent, Severity::Warning,
                                 "agent restarted: values now come from its new start"));
    } else if (before.lost() && !agent.lost()) {
        events.push_back(eventOf(agent, Severity::Info, "agent heard again"));
    }
    const bool fresh =
        agent.lost() && (!before.lost() || before.status.epoch != agent.status.epoch);
    if (!fresh) return;
    events.push_back(agent.status.ended ? eventOf(agent, Severity::Info, "agent ended: it said so")
                                        : eventOf(agent, Severity::Warning,
                                                  "agent lost: its values are the last ones"));
}

// Those that the mirror has forgotten, with ages that go on.
void LostAgents::keep(std::vector<AgentFrame>& agents, Moment now) {
    std::map<std::string, Known> known;
    for (const AgentFrame& agent : agents) known.try_emplace(agent.status.name, agent, now);
    for (auto& [name, each] : known_) {
        if (known.contains(name) || !each.frame.isSilent()) continue;
        AgentFrame old = each.frame.later(std::chrono::duration<double>(now - each.when).count());
        note(old);
        const bool dismissed = dismissed_.erase({name, each.frame.status.epoch}) > 0;
        if (dismissed || known.size() >= mostKept) continue;
        agents.push_back(std::move(old));
        known.emplace(name, std::move(each));
    }
    known_ = std::move(known);
    std::ranges::sort(agents, {}, [](const AgentFrame& each) { return each.status.name; });
}

void LostAgents::dismiss(const std::string& agent) {
    const auto found = known_.find(agent);
    if (found == known_.end() || !found->second.frame.lost()) return;
    dismissed_.insert({agent, found->second.frame.status.epoch});
}

}  // namespace cortex::gui
