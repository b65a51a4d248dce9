// SPDX-License-Identifier: Apache-2.0
#include "mirror/mirror_agents.hpp"

#include "security/security_identity.hpp"
#include "wire/ids.hpp"
#include "wire/presence_extras.hpp"
#include "wire/presence_interval.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace cortex::comms {
namespace {

constexpr std::size_t mostAgents = 10'000;
constexpr std::chrono::seconds forgottenAfter{61}, awaitedFor{15};

// Visits those of an agent's own simplexes that a view shows.
template <class Visit>
void forShown(const Structure& structure, const MirrorView& view, Visit visit) {
    for (std::uint32_t i = 0; i < structure.simplexes.size(); ++i) {
        const SimplexInfo& info = structure.simplexes[i];
        if (!info.remote && view.shows(info.path)) visit(i);
    }
}

bool showsAny(const Structure& structure, const MirrorView& view) {
    bool any = false;
    forShown(structure, view, [&](std::uint32_t) { any = true; });
    return any;
}

}  // namespace

// Null: the sample is refused, or another start of the name was there first.
MirrorAgent* MirrorAgents::at(const std::string& name, std::int64_t epoch, Moment now) {
    const auto found = agents_.find(name);
    if (found != agents_.end()) {
        if (epoch == found->second.model.epoch()) return &found->second;
        if (found->second.holdsName(now)) return nullptr;
        lose(found->second, "another start of it has taken its place");
        if (found->second.tables) forgottenImages_ += found->second.tables->published();
        std::optional<PeerModel> aside = takeAside(name, epoch);
        aside_.insert_or_assign(name, std::move(found->second.model));
        found->second = MirrorAgent{name, epoch, now};
        found->second.since = sinceAt(now);
        if (aside) found->second.model = std::move(*aside);
        return &found->second;
    }
    if (name.empty() || agents_.size() >= mostAgents) {
        ++refused_;
        return nullptr;
    }
    names_[agentId(name)] = name;
    MirrorAgent& agent = agents_.try_emplace(name, name, epoch, now).first->second;
    agent.since = sinceAt(now);
    if (std::optional<PeerModel> aside = takeAside(name, epoch)) agent.model = std::move(*aside);
    return &agent;
}

// Those that are met within two seconds of the first were there before.
Moment MirrorAgents::sinceAt(Moment now) {
    if (began_ == Moment{}) began_ = now;
    return now - began_ > std::chrono::nanoseconds{timeToMeet} ? now : Moment{};
}

std::optional<PeerModel> MirrorAgents::takeAside(const std::string& name, std::int64_t epoch) {
    const auto found = aside_.find(name);
    if (found == aside_.end() || found->second.epoch() != epoch) return {};
    std::optional<PeerModel> model = std::move(found->second);
    aside_.erase(found);
    return model;
}

// A model comes only once. So that of an earlier start is kept in case the later one is lost.
void MirrorAgents::setAside(const Model& model) {
    if (!agents_.contains(model.agent)) return;
    auto place = aside_.try_emplace(model.agent, model.agent, model.epoch).first;
    if (place->second.epoch() < model.epoch) place->second = PeerModel{model.agent, model.epoch};
    place->second.add(model);
}

// The agent may only have been cut off, and DDS does not deliver a sample twice.
void MirrorAgents::forget(MirrorAgent& agent) {
    const std::string name = agent.model.agent();
    if (aside_.size() < mostAgents) aside_.insert_or_assign(name, std::move(agent.model));
}

void MirrorAgents::take(const Presence& presence, Moment now) {
    if (presence.role != "agent") return;
    MirrorAgent* const known = find(presence.name);
    const bool isOther = known != nullptr && known->model.epoch() != presence.epoch;
    if (presence.state != "running") {
        if (known == nullptr || isOther) return;
        known->goodbye = presence.state == "silent" ? "another start of it was there first"
                                                    : "the agent has ended";
        return;
    }
    MirrorAgent* agent = at(presence.name, presence.epoch, now);
    if (agent == nullptr || !agent->model.add(presence)) return;
    finish(*agent);
    agent->goodbye = nullptr;
    agent->seniority.take(presence, now.time_since_epoch().count());
    if (agent->lost) agent->since = sinceAt(now);
    structuresChanged_ = structuresChanged_ || agent->lost;
    if (agent->tables) agent->tables->find();
    agent->heard = now;
    agent->lost = agent->missed = false;
    agent->cycle = std::max(agent->cycle, presence.cycle);
    agent->clock = timeIn(presence, clockOfAgent);
    agent->clockHeard = now;
    const auto age = timeIn(presence, ageOfLoop);
    agent->moved = now - std::chrono::nanoseconds{age};
}

void MirrorAgents::take(const Model& model, Moment now) {
    MirrorAgent* agent = find(model.agent);
    const bool isOther = agent != nullptr && !agent->lost && agent->model.epoch() != model.epoch;
    if (!isOther) agent = at(model.agent, model.epoch, now);
    if (isOther || agent == nullptr) return setAside(model);
    if (agent->model.add(model)) finish(*agent);
}

const MirrorAgent* MirrorAgents::take(const Block& block, std::size_t stream, Moment now) {
    const auto name = names_.find(block.agent);
    MirrorAgent* agent = name != names_.end() ? find(name->second) : nullptr;
    if (agent == nullptr || !agent->tables || !agent->viewed) return nullptr;
    if (block.cycle > agent->cycle) agent->moved = now;
    // What is sent again while the loop stands still is as old as its cycle.
    if (!agent->tables->apply(block, stream, agent->moved)) return nullptr;
    if (agent->moved < now) {
        agent->tables->markStale(now, agent->model.presence()->period);
    }
    hear(*agent, block.cycle, now);
    return agent;
}

// By what it sends of its cycles.
void MirrorAgents::hear(MirrorAgent& agent, std::int64_t cycle, Moment now) {
    agent.heard = now;
    structuresChanged_ = structuresChanged_ || agent.lost;
    agent.lost = agent.missed = false;
    agent.cycle = std::max(agent.cycle, cycle);
}

bool MirrorAgents::take(const Summary& summary, Moment now) {
    const auto name = names_.find(summary.agent);
    MirrorAgent* agent = name != names_.end() ? find(name->second) : nullptr;
    if (agent == nullptr || !agent->structure) return false;
    const Structure& structure = *agent->structure;
    const auto own = std::ranges::count(structure.simplexes, false, &SimplexInfo::remote);
    const bool isOfIt = summary.epoch == structure.epoch &&
                        summary.structureHash == agent->model.presence()->structureHash;
    const Moment moved = summary.cycle > agent->cycle ? now : agent->moved;
    if (!isOfIt || !agent->summary.take(summary, static_cast<std::size_t>(own), moved)) {
        ++refused_;
        return false;
    }
    agent->moved = moved;
    hear(*agent, summary.cycle, now);
    return true;
}

void MirrorAgents::forgetSummaries() {
    for (auto& [name, agent] : agents_) agent.summary = {};
}

std::optional<AgentEvent> MirrorAgents::take(const EventMessage& message) {
    const auto severity = severityFromName(message.severity);
    if (message.agent != agentId(message.name) || !severity) {
        ++refused_;
        return {};
    }
    if (newestEvents_.size() < mostAgents || newestEvents_.contains(message.name)) {
        auto& newest = newestEvents_[message.name];
        newest = std::max(newest, {message.epoch, message.number});
    }
    MirrorAgent* agent = find(message.name);
    if (agent != nullptr && agent->model.epoch() == message.epoch) {
        if (agent->lastEvent != 0 && message.number > agent->lastEvent + 1) {
            agent->eventLoss += message.number - agent->lastEvent - 1;
        }
        agent->lastEvent = std::max(agent->lastEvent, message.number);
    }
    AgentEvent event{message.name, message.epoch, message.number, message.cycle, message.wallClock,
                     *severity,    message.kind,  message.path,   message.text};
    if (!textIn(message, repeatable).empty()) event.repeatable = numberIn(message, repeatable);
    return event;
}

// Builds the structure once the model is complete, and tables once it is viewed.
void MirrorAgents::finish(MirrorAgent& agent) {
    if (agent.foreign() || !agent.model.complete()) return;
    const auto structure = agent.model.structure();
    if (structure == agent.structure) return;
    agent.structure = structure;
    agent.known = std::chrono::steady_clock::now();
    structuresChanged_ = true;
    if (identity_ != nullptr) {
        agent.rights = identity_->shownBy(agent.model.agent(), agent.model.authority());
    }
    agent.commands.reset();
    agent.summary = {};
    if (agent.tables) forgottenImages_ += agent.tables->published();
    agent.tables.reset();
}

void MirrorAgents::withdraw(const Id& agent) {
    const auto name = names_.find(agent);
    MirrorAgent* found = name != names_.end() ? find(name->second) : nullptr;
    if (found != nullptr) found->goodbye = "the agent has ended";
}

// It may be cut off or stand still, and go on: commands to it wait for their answers meanwhile.
void MirrorAgents::miss(MirrorAgent& agent) {
    agent.lost = agent.missed = true;
    structuresChanged_ = true;
    if (agent.tables) agent.tables->lose();
}

void MirrorAgents::lose(MirrorAgent& agent, const char* why) {
    if (agent.lost && !agent.missed) return;
    if (!agent.lost) miss(agent);
    agent.missed = false;
    onLost_(agent, why);
}

void MirrorAgents::excuse(std::chrono::nanoseconds still, Moment now) {
    for (auto& [name, agent] : agents_) agent.heard = std::min(now, agent.heard + still);
}

void MirrorAgents::tick(const MirrorView& view, Moment now) {
    for (auto each = agents_.begin(); each != agents_.end();) {
        MirrorAgent& agent = each->second;
        if (agent.goodbye != nullptr && agent.isGone(now)) lose(agent, agent.goodbye);
        if (!agent.lost && now - agent.heard > agent.patience()) miss(agent);
        if (now - agent.heard > forgottenAfter) {
            lose(agent, "the agent was not heard for a minute");
            if (agent.tables) forgottenImages_ += agent.tables->published();
            names_.erase(agentId(each->first));
            forget(agent);
            each = agents_.erase(each);
            structuresChanged_ = true;
            continue;
        }
        if (!agent.tables) agent.viewed = agent.structure && showsAny(*agent.structure, view);
        if (agent.viewed && !agent.tables) {
            const Id& hash = agent.model.presence()->structureHash;
            agent.tables = std::make_shared<MirrorTables>(agent.structure, hash, view);
        }
        if (agent.tables && !view.empty()) {
            agent.tables->markStale(now, agent.model.presence()->period);
        }
        ++each;
    }
}

void MirrorAgents::view(const MirrorView& view) {
    for (auto& [name, agent] : agents_) {
        if (!agent.tables) continue;
        agent.viewed = showsAny(*agent.structure, view);
        agent.tables->restart(view);  // what came stays, in case the agent is lost
    }
}

MirrorAgent* MirrorAgents::find(std::string_view name) {
    const auto found = agents_.find(name);
    return found != agents_.end() ? &found->second : nullptr;
}

bool MirrorAgents::missesAny() const {
    return std::ranges::any_of(agents_, [](const auto& each) { return each.second.missed; });
}

bool MirrorAgents::awaitsAny(Moment now) const {
    return std::ranges::any_of(agents_, [now](const auto& each) {
        return each.second.missed && now - each.second.heard < awaitedFor;
    });
}

bool MirrorAgents::hearsAny() const {
    return std::ranges::any_of(agents_, [](const auto& each) { return !each.second.lost; });
}

bool MirrorAgents::complete() const {
    return !agents_.empty() &&
           std::ranges::all_of(agents_, [](const auto& each) { return each.second.settled(); });
}

std::uint32_t MirrorAgents::unheard() const {
    std::uint64_t here = 0, most = 0;
    for (const auto& [name, agent] : agents_) {
        if (!agent.present() || agent.lost) continue;
        ++here;
        most = std::max(most, numberIn(*agent.model.presence(), agentsHeard));
    }
    return most > here
               ? static_cast<std::uint32_t>(std::min(most - here, std::uint64_t{mostAgents}))
               : 0;
}

// Events come in order, perhaps before the agent is known.
bool MirrorAgents::eventsComplete() const {
    return std::ranges::all_of(agents_, [&](const auto& each) {
        const auto& [name, agent] = each;
        if (agent.lost || !agent.present()) return true;
        const std::uint64_t last = numberIn(*agent.model.presence(), eventsWritten);
        const auto newest = newestEvents_.find(name);
        return last == 0 || (newest != newestEvents_.end() &&
                             newest->second >= std::pair{agent.model.epoch(), last});
    });
}

bool MirrorAgents::valuesComplete(const MirrorView& view) const {
    bool all = true;
    for (const auto& [name, agent] : agents_) {
        if (agent.lost || !agent.structure) continue;
        forShown(*agent.structure, view, [&](std::uint32_t simplex) {
            all = all && agent.tables && agent.tables->received(simplex);
        });
    }
    return all;
}

std::uint64_t MirrorAgents::images() const {
    std::uint64_t count = forgottenImages_;
    for (const auto& [name, agent] : agents_) {
        if (agent.tables) count += agent.tables->published();
    }
    return count;
}

std::uint64_t MirrorAgents::refused() const {
    std::uint64_t count = refused_;
    for (const auto& [name, agent] : agents_) {
        count += agent.model.refused() + (agent.tables ? agent.tables->refused() : 0);
    }
    return count;
}

}  // namespace cortex::comms
