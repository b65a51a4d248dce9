// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_past.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/event_memory.hpp"

#include "wire/presence_extras.hpp"
#include "wire/presence_interval.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace cortex::comms {
namespace {

constexpr std::size_t mostTools = 256, mostBytes = 32'000;
constexpr std::int64_t pause = 80'000'000;  // before the same is said again
constexpr std::int64_t mostAnswers = 16, timeOfAnswer = 10'000'000;  // of all tools together
constexpr int timesOfAnswer = 3;

}  // namespace

void AgentPast::take(const Presence& presence, std::int64_t now) {
    if (presence.role != "tool" || presence.state != "running") return;
    for (const Extra& extra : presence.extras) {
        if (extra.name != ofThePast) continue;
        auto ask = pastAskFrom(extra.value);
        if (!ask || ask->agent != self_.name) continue;
        if (asked_.size() >= mostTools && !asked_.contains(presence.name)) return;
        Asked& asked = asked_[presence.name];
        if (asked.ask != *ask) asked = {std::move(*ask)};
        asked.until = now + patienceWith(presence);
        asked.times = timesOfAnswer;
        return;
    }
    asked_.erase(presence.name);
}

// Who has got what it asked for asks for something else, or for nothing.
void AgentPast::step(std::int64_t now) {
    std::erase_if(asked_, [now](const auto& each) { return each.second.until < now; });
    auto next = asked_.upper_bound(last_);
    for (std::size_t looked = 0; looked < asked_.size(); ++looked, ++next) {
        if (next == asked_.end()) next = asked_.begin();
        auto& [tool, each] = *next;
        const bool isEarly = each.answered != 0 && now - each.answered < pause;
        if (each.times == 0 || isEarly) continue;
        if (!allowance_.take(now, mostAnswers, timeOfAnswer)) return;
        each.answered = now;
        --each.times;
        last_ = tool;
        answer(tool, each.ask);
    }
}

void AgentPast::answer(const std::string& tool, const PastAsk& ask) {
    const EventMemory& memory = *self_.access.memory;
    PastMessage message;
    message.agent = self_.id;
    message.name = self_.name;
    message.epoch = self_.epoch;
    message.tool = tool;
    message.ask = ask.number;
    message.after = message.last = ask.after;
    const EventMemory::Page page = memory.page(ask.after, ask.from, ask.until, mostBytes);
    message.more = page.more;
    for (const KeptEvent& each : page.events) {
        message.last = each.place;
        message.events.push_back({each.epoch, each.number, each.cycle, each.wallClock,
                                  name(each.severity), name(each.kind), each.path, each.text});
    }
    const auto since = memory.since();
    for (std::size_t i = 0; i < since.size(); ++i)
        message.kept.push_back({name(EventMemory::kinds[i]), since[i]});
    try {
        if (!writer_) writer_ = participant_.writer<PastMessage>(topics::past);
        writer_->write(message);
    } catch (const Error& error) {
        self_.rejections.add(error.what());
    }
}

}  // namespace cortex::comms
