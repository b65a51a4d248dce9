// SPDX-License-Identifier: Apache-2.0
#include "model/event_past.hpp"

#include "cortex/core/event_memory.hpp"

#include "model/shown_time.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace cortex::gui {

namespace {

constexpr std::int64_t hourInNs = 3'600'000'000'000;
constexpr double patienceWithClock = 3;  // s, for the first values, which have the agent's clock
constexpr qint64 betweenMerges = 1000;   // ms

// From then on no change of state is missing: the last one of a simplex is the last one that was.
std::int64_t wholeSince(const comms::PastEvents& past) {
    std::int64_t since = past.trouble.empty() ? 0 : EventMemory::always;
    for (const auto& each : past.since) {
        const bool counts = each.kind == cortex::name(EventKind::StateChange) ||
                            each.kind == cortex::name(EventKind::Fault);
        if (counts) since = std::max(since, each.time);
    }
    return since;
}

}  // namespace

EventPast::EventPast(Session& session, EventModel& events, StateTimes& times)
    : past_{session}, events_{events}, times_{times} {}

QString EventPast::name(Back back) {
    switch (back) {
        case Back::Hour:
            return tr("Last hour");
        case Back::Day:
            return tr("Last day");
        default:
            return tr("All kept");
    }
}

std::int64_t EventPast::from(std::int64_t now) const {
    if (back_ == Back::All) return 0;
    return now - (back_ == Back::Hour ? 1 : 24) * hourInNs;
}

void EventPast::ask(Back back) {
    back_ = back;
    now_ = 0;
    for (auto& [name, each] : asked_) {
        each.waits = true;
        each.reach.asking = true;
    }
}

// By the clock of each agent, as soon as that is known.
void EventPast::refresh(const Frame& frame) {
    past_.deliver();
    for (const AgentFrame& agent : frame.agents) {
        const auto [found, isNew] = asked_.try_emplace(agent.status.name);
        Asked& asked = found->second;
        const bool again = asked.epoch != agent.status.epoch || (asked.lost && !agent.lost());
        if (isNew || again) {
            asked.reach = {agent.status.name, agent.status.epoch * 1000, true, true, {}, {}};
            asked.epoch = agent.status.epoch;
            asked.since = frame.seconds;
            asked.waits = true;
        }
        asked.lost = agent.lost();
        // An image of which nothing has come yet has no time.
        const std::int64_t clock = agent.image && *agent.image ? (*agent.image)->wallClock() : 0;
        const bool knowsClock = clock != 0;
        const bool waited = frame.seconds - asked.since > patienceWithClock;
        const bool answersAtOnce = agent.lost() || !agent.status.remembers;  // that it cannot
        if (!asked.waits || !(knowsClock || answersAtOnce || waited)) continue;
        ask(agent, asked, knowsClock ? clock : frame.utc);
    }
    std::erase_if(asked_, [&](const auto& each) {
        return std::ranges::none_of(
            frame.agents, [&](const AgentFrame& agent) { return agent.status.name == each.first; });
    });
    const bool soon = isAsked() && merged_.isValid() && merged_.elapsed() < betweenMerges &&
                      came_.size() < events_.kept();
    if (came_.empty() || soon) return;
    times_.add(std::exchange(changes_, {}));
    events_.addPast(std::exchange(came_, {}));
    merged_.start();
}

bool EventPast::isAsked() const {
    return std::ranges::any_of(asked_, [](const auto& each) { return each.second.reach.asking; });
}

bool EventPast::asking() const { return isAsked() || !came_.empty(); }

void EventPast::ask(const AgentFrame& agent, Asked& asked, std::int64_t now) {
    asked.waits = false;
    asked.reach.asking = true;
    asked.reach.remembers = agent.status.remembers || agent.lost();
    asked.round = ++round_;
    asked.when = now;
    now_ = std::max(now_, now);
    past_.ask(agent.status.name, from(now), EventMemory::always, this,
              [this, name = agent.status.name, round = asked.round](comms::PastEvents past) {
                  take(name, round, std::move(past));
              });
}

void EventPast::take(const std::string& agent, std::uint64_t round, comms::PastEvents past) {
    const std::int64_t whole = wholeSince(past);
    std::ranges::copy_if(past.events, std::back_inserter(changes_),
                         [&](const auto& each) { return each.wallClock >= whole; });
    std::ranges::move(past.events, std::back_inserter(came_));
    const auto found = asked_.find(agent);
    if (found == asked_.end() || found->second.round != round) return;
    PastReach& reach = found->second.reach;
    reach.asking = false;
    reach.trouble = std::move(past.trouble);
    reach.since = std::move(past.since);
}

std::int64_t EventPast::valuesUntil() const {
    std::int64_t until = 0;
    for (const auto& [name, each] : asked_) {
        const PastReach& reach = each.reach;
        if (reach.asking || !reach.trouble.empty()) continue;
        until = until == 0 ? each.when : std::min(until, each.when);
    }
    return until;
}

QString EventPast::reach() const {
    std::vector<PastReach> all;
    for (const auto& [name, each] : asked_) all.push_back(each.reach);
    QString text = reachText(all, from(now_));
    const std::int64_t until = valuesUntil();
    if (until == 0 || isAsked()) return text;
    return tr("Changes of values are known until %1; %2 asks again. %3")
        .arg(timeAndZone(until, "HH:mm:ss"), name(back_), text);
}

}  // namespace cortex::gui
