// SPDX-License-Identifier: Apache-2.0
#include "mirror/mirror_past.hpp"

#include "wire/ids.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <set>
#include <utility>

namespace cortex::comms {
namespace {

constexpr std::size_t mostAtOnce = 4, mostEvents = 1'000'000, mostKinds = 64;
constexpr std::size_t mostOctets = mostEvents * 256;
constexpr std::chrono::seconds patienceWithPart{5}, patienceWithAll{600};

// None: it makes no sense.
std::optional<AgentEvent> eventOf(const std::string& agent, const PastEventMessage& message) {
    const auto severity = severityFromName(message.severity);
    if (!severity) return {};
    return AgentEvent{agent,     message.epoch, message.number, message.cycle, message.wallClock,
                      *severity, message.kind,  message.path,   message.text};
}

}  // namespace

std::uint64_t MirrorPast::ask(const std::string& agent, std::int64_t from, std::int64_t until) {
    Asked asked;
    asked.ask = {++number_, from, until, 0, agent};
    asked.past.agent = agent;
    asked_.emplace(number_, std::move(asked));
    return number_;
}

bool MirrorPast::poll(std::uint64_t number, PastEvents& past) {
    const auto found = asked_.find(number);
    if (found == asked_.end() || !found->second.over) return false;
    past = std::move(found->second.past);
    asked_.erase(found);
    return true;
}

PastEvents MirrorPast::giveUp(std::uint64_t number) {
    const auto found = asked_.find(number);
    if (found == asked_.end()) return {};
    PastEvents past = std::move(found->second.past);
    asked_.erase(found);
    return past;
}

void MirrorPast::finish(Asked& asked, std::string trouble) {
    asked.over = true;
    asked.past.trouble = std::move(trouble);
}

// That it answers: not another tool's, and not what has come already.
MirrorPast::Asked* MirrorPast::asked(const PastMessage& message) {
    if (message.tool != self_ || message.agent != agentId(message.name)) return nullptr;
    const auto found = asked_.find(message.ask);
    if (found == asked_.end() || found->second.over) return nullptr;
    const PastAsk& ask = found->second.ask;
    return ask.agent == message.name && ask.after == message.after ? &found->second : nullptr;
}

void MirrorPast::take(const PastMessage& message, Moment now) {
    Asked* const found = asked(message);
    if (found == nullptr) return;
    PastEvents& past = found->past;
    if (found->epoch != 0 && found->epoch != message.epoch) {  // its places are of another start
        past.events.clear();
        found->ask.after = 0;
        found->epoch = 0;
        return;
    }
    const bool stands = message.more && (message.last <= message.after || message.events.empty());
    if (stands || message.kept.size() > mostKinds) return void(++refused_);
    found->epoch = message.epoch;
    found->moved = now;
    found->ask.after = message.last;
    for (const PastEventMessage& each : message.events) {
        found->octets += each.kind.size() + each.path.size() + each.text.size();
        if (auto event = eventOf(message.name, each)) {
            past.events.push_back(std::move(*event));
        } else {
            ++refused_;
        }
    }
    past.since.clear();
    for (const KeptSinceMessage& each : message.kept) past.since.push_back({each.kind, each.since});
    if (!message.more) finish(*found, "");
    if (past.events.size() > mostEvents || found->octets > mostOctets)
        finish(*found, "it sends more than can be taken");
}

// One of each agent at a time.
void MirrorPast::begin(Moment now) {
    std::set<std::string> busy;
    for (auto& [number, each] : asked_) {
        if (!each.over && each.moved) busy.insert(each.ask.agent);
    }
    for (auto& [number, each] : asked_) {
        if (each.over || each.moved || busy.size() >= mostAtOnce) continue;
        if (!busy.insert(each.ask.agent).second) continue;
        each.begun = now;
        each.moved = now;
    }
}

void MirrorPast::tick(const MirrorAgents& agents, Moment now) {
    for (auto& [number, each] : asked_) {
        if (each.over) continue;
        const auto found = agents.all().find(each.ask.agent);
        const MirrorAgent* agent = found != agents.all().end() ? &found->second : nullptr;
        if (agent == nullptr || agent->lost) {
            finish(each, "it is not heard");
        } else if (agent->present() && !agent->remembers()) {
            finish(each, "it was built before agents kept a memory");
        } else if (each.moved && now - *each.moved > patienceWithPart) {
            finish(each,
                   "it did not answer within " + std::to_string(patienceWithPart.count()) + " s");
        } else if (each.moved && now - each.begun > patienceWithAll) {
            finish(each, "it did not send all of it within " +
                             std::to_string(patienceWithAll.count()) + " s");
        }
    }
    begin(now);
}

std::vector<std::string> MirrorPast::words() const {
    std::vector<std::string> words;
    for (const auto& [number, each] : asked_) {
        if (!each.over && each.moved) words.push_back(textOf(each.ask));
    }
    return words;
}

bool MirrorPast::waiting() const {
    return std::ranges::any_of(asked_, [](const auto& each) { return !each.second.over; });
}

}  // namespace cortex::comms
