// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_events.hpp"

#include "wire/presence_extras.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

namespace cortex::comms {
namespace {

constexpr std::size_t mostWaiting = 10'000, mostAtOnce = 64;

EventMessage messageOf(const Event& event, const Structure& structure, const EventMessage& head) {
    EventMessage message = head;
    message.number = event.number;
    message.cycle = event.cycle;
    message.wallClock = event.wallClock;
    message.severity = name(event.severity);
    message.kind = name(event.kind);
    message.path = event.simplex < structure.simplexes.size()
                       ? structure.simplexes[event.simplex].path
                       : "/" + structure.agent;
    message.text = event.text.view();
    message.extras.push_back({repeatable, std::to_string(event.repeatable)});
    return message;
}

// The oldest that is no error, or the oldest of all.
auto leastWanted(std::deque<EventMessage>& messages) {
    const std::string error = name(Severity::Error);
    const auto found = std::ranges::find_if(
        messages, [&](const EventMessage& each) { return each.severity != error; });
    return found != messages.end() ? found : messages.begin();
}

}  // namespace

AgentEvents::AgentEvents(const AgentSelf& self) {
    EventMessage head;
    head.agent = self.id;
    head.name = self.name;
    head.epoch = self.epoch;
    self.access.events->addSink(
        [queue = queue_, head](const Event& event, const Structure& structure) {
            const std::lock_guard lock{queue->mutex};
            if (!queue->open) return;
            auto& messages = queue->messages;
            if (messages.size() >= mostWaiting) messages.erase(leastWanted(messages));
            messages.push_back(messageOf(event, structure, head));
        },
        EventLog::Repeats::Folded);
}

AgentEvents::~AgentEvents() {
    const std::lock_guard lock{queue_->mutex};
    queue_->open = false;
}

bool AgentEvents::take(std::vector<EventMessage>& emptied) {
    const std::lock_guard lock{queue_->mutex};
    auto& messages = queue_->messages;
    while (!messages.empty() && emptied.size() < mostAtOnce) {
        emptied.push_back(std::move(messages.front()));
        messages.pop_front();
    }
    return messages.empty();
}

bool AgentEvents::empty() const {
    const std::lock_guard lock{queue_->mutex};
    return queue_->messages.empty();
}

}  // namespace cortex::comms
