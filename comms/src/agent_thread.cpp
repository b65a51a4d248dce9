// SPDX-License-Identifier: Apache-2.0
#include "agent_thread.hpp"

#include "security_identity.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

namespace cortex::comms {
namespace {

constexpr std::chrono::milliseconds longestWait{20};
constexpr std::int64_t presenceInterval = 100'000'000;  // ns

}  // namespace

AgentThread::AgentThread(const AgentAccess& agent, const NetworkOptions& options)
    : self_{agent},
      model_{self_, options.security.empty() ? "" : securityOn},
      participant_{options, self_.name},
      presenceOut_{participant_.writer<Presence>(topics::presence)},
      modelOut_{participant_.writer<Model>(topics::model)},
      answerOut_{participant_.writer<Answer>(topics::answer)},
      eventOut_{participant_.writer<EventMessage>(topics::event)},
      events_{self_},
      commands_{self_,
                [this](const Answer& answer) {
                    if (!silent_) answerOut_->write(answer);
                },
                participant_.identity()},
      links_{self_},
      streams_{self_, model_.structureHash(), participant_},
      peers_{self_, links_.any(),
             [this](const std::string& name, std::int64_t epoch) { commands_.lost(name, epoch); }},
      presenceIn_{receive<Presence>({topics::presence.name, Qos::Cycle})},  // the next comes soon
      modelIn_{receive<Model>(topics::model)},
      linkIn_{links_.any() ? receive<Block>(topics::link) : nullptr},
      commandIn_{receive<Command>(topics::command)},
      thread_{[this] { run(); }} {}

AgentThread::~AgentThread() {
    self_.access.events->flush();
    stopping_.store(true);
    wake_.signal();
    thread_.join();
}

template <class Message>
std::unique_ptr<Reader<Message>> AgentThread::receive(const Topic& topic) {
    return participant_.reader<Message>(topic, [this](Message&& message) {
        if (received_.push(std::move(message), steadyNow())) {
            wake_.signal();
        } else {
            self_.rejections.add("more messages than can be taken");
        }
    });
}

void AgentThread::read(Inbox& inbox) {
    links_.read(inbox);
    commands_.read(inbox);
}

void AgentThread::write(Outbox& outbox) {
    const bool answers = commands_.write(outbox);
    if (answers || everyCycle_.load(std::memory_order_relaxed)) wake_.signal();
}

void AgentThread::run() {
    for (const Model& sample : model_.samples()) modelOut_->write(sample);
    while (!stopping_.load()) {
        guarded([this] { step(); });
        wake_.waitFor(longestWait);
    }
    guarded([this] { sayGoodbye(); });
}

// Whatever others send, this thread goes on.
template <class Function>
void AgentThread::guarded(Function function) {
    try {
        function();
    } catch (const std::exception& error) {
        self_.rejections.add(error.what());
        messages_ = {};
    }
}

void AgentThread::step() {
    const std::int64_t now = steadyNow();
    if (!silent_) streams_.step(now);
    takeMessages(now);
    reportRefusals();
    peers_.expire(now);
    if (peers_.takeChanged()) changed();
    if (links_.askAgain(now)) sendInterests();
    commands_.step(now);
    sendEvents();
    if (peers_.outranked()) fallSilent();
    if (!silent_) sendPresence(now);
}

void AgentThread::takeMessages(std::int64_t now) {
    received_.take(messages_);
    for (auto& [block, came] : messages_.blocks) links_.take(block, came);
    for (auto& [presence, came] : messages_.presences) {
        peers_.take(presence, came);
        if (presence.state != "stopping") commands_.heard(presence.name, presence.epoch, came);
    }
    for (auto& [model, came] : messages_.models) peers_.take(model, came);
    for (auto& [command, came] : messages_.commands) {
        if (!silent_) commands_.take(command, now);
    }
    messages_.blocks.clear();
    messages_.presences.clear();
    messages_.models.clear();
    messages_.commands.clear();
}

void AgentThread::reportRefusals() {
    for (const std::string& each : participant_.takeRefusals()) {
        self_.event(Severity::Warning, self_.simplex, each);
    }
}

void AgentThread::changed() {
    links_.update(peers_.all());
    streams_.update(peers_.all());
    everyCycle_.store(streams_.any(), std::memory_order_relaxed);
    sendInterests();
}

void AgentThread::sendInterests() {
    for (Interest& interest : links_.newInterests(peers_.all())) {
        if (!silent_) modelOut_->write(model_.sampleOf(std::move(interest)));
    }
}

void AgentThread::sendEvents() {
    if (!events_.take(eventsToSend_)) wake_.signal();  // the next step follows at once
    for (const EventMessage& event : eventsToSend_) {
        if (!silent_) eventOut_->write(event);
    }
    eventsToSend_.clear();
}

Presence AgentThread::presence(const char* state) const {
    return model_.presence(state, peers_.agents() + 1);
}

void AgentThread::sendPresence(std::int64_t now) {
    if (now < presenceDue_) return;
    presenceOut_->write(presence("running"));
    presenceDue_ = std::max(presenceDue_ + presenceInterval, now + presenceInterval / 2);
}

// The network belongs to the later start: the last that is heard of this one.
void AgentThread::fallSilent() {
    if (std::exchange(silent_, true)) return;
    presenceOut_->write(presence("silent"));
}

// After the last cycle. Without dispose where we fell silent: the keys are the later start's.
void AgentThread::sayGoodbye() {
    step();
    if (silent_) return;
    while (!events_.empty()) sendEvents();
    const Presence last = presence("stopping");
    presenceOut_->write(last);
    presenceOut_->dispose(last);
}

}  // namespace cortex::comms
