// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_thread.hpp"

#include "cortex/core/clock.hpp"
#include "cortex/core/error.hpp"
#include "cortex/core/loop_pace.hpp"
#include "cortex/core/service_threads.hpp"
#include "cortex/core/standstill.hpp"

#include "security/security_identity.hpp"
#include "wire/presence_extras.hpp"
#include "wire/presence_interval.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <exception>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>

namespace cortex::comms {
namespace {

// Waking costs more than taking what has come. So the thread wakes less often in a crowd.
constexpr std::chrono::milliseconds shortestWait{1}, longestWait{20}, longestInCrowd{100};
constexpr std::chrono::microseconds moreForEach{500};
constexpr std::size_t mostLostOwners = 16;
constexpr std::int64_t muchTooEarly = 100'000;      // ns
constexpr std::int64_t shortestExpected = 500'000;  // ns; of less, too much would be waited awake
constexpr std::int64_t lead = 20'000;               // ns, before and after an expected write
constexpr std::int64_t silentInterval = 1'000'000'000;  // ns
constexpr std::size_t longestReason = 200;              // of a refusal, in a presence
constexpr int timesStopping = 3;
constexpr std::chrono::milliseconds pauseStopping{10};

// Commands and answers are urgent. Everything else waits for the next step.
template <class Message>
constexpr bool isUrgent = std::same_as<Message, Command> || std::same_as<Message, Answer>;

}  // namespace

AgentThread::AgentThread(const AgentAccess& agent, const NetworkOptions& options)
    : self_{agent},
      model_{self_, options.security.empty() ? "" : securityOn},
      participant_{options, self_.name, Participant::Speaks::WhenTold},
      presenceOut_{participant_.writer<Presence>(topics::presence)},
      modelOut_{participant_.writer<Model>(topics::model)},
      eventOut_{participant_.writer<EventMessage>(topics::event)},
      events_{self_},
      answers_{participant_},
      commands_{self_, [this](const Answer& answer) { sendAnswer(answer); },
                participant_.identity()},
      links_{self_},
      interestOut_{links_.any() ? participant_.writer<Interest>(topics::interest) : nullptr},
      streams_{self_, model_.structureHash(), participant_},
      calls_{self_, links_, participant_},
      peers_{self_,
             [this](const std::string& name, std::int64_t epoch) { commands_.lost(name, epoch); }},
      presenceIn_{receive<Presence>({topics::presence.name, Qos::Cycle})},  // the next comes soon
      modelIn_{links_.any() ? receive<Model>(topics::model) : nullptr},
      interestIn_{receive<Interest>(topics::interest)},
      commandIn_{receive<Command>(topics::command)},
      answerIn_{calls_.any() ? receive<Answer>(topics::answerTo(self_.name)) : nullptr} {
    for (const Model& sample : model_.samples()) modelOut_->write(sample);
    sendInterest();
    participant_.speak();
    const ServiceThreads named{"cortex-comms"};
    thread_ = std::thread{[this] { run(); }};
}

AgentThread::~AgentThread() {
    self_.access.events->flush();
    stopping_.store(true);
    signals_.wake();
    thread_.join();
}

template <class Message>
std::unique_ptr<Reader<Message>> AgentThread::receive(const Topic& topic) {
    return participant_.reader<Message>(topic, [this](Message&& message) {
        if (!received_.push(std::move(message), monotonicNow())) {
            self_.rejections.add("more messages than can be taken");
        } else if (isUrgent<Message>) {
            signals_.wake();
        }
    });
}

void AgentThread::read(Inbox& inbox) {
    links_.read(inbox);
    commands_.read(inbox);
    calls_.read(inbox);
}

// A communication thread that waits for this write comes by itself, unless it is much too early.
void AgentThread::write(Outbox& outbox) {
    streams_.keep();
    const bool answers = commands_.write(outbox);
    const bool calls = calls_.write(outbox);
    const bool everyCycle = everyCycle_.load(std::memory_order_relaxed);
    if (!answers && !calls && !everyCycle) return;
    bool isTooEarly = false;
    if (everyCycle) {
        const std::int64_t now = monotonicNow();
        isTooEarly = now < next_.load(std::memory_order_relaxed) - muchTooEarly;
        next_.store(now + self_.access.period, std::memory_order_relaxed);
    }
    if (isTooEarly)
        signals_.wake();
    else
        signals_.advance();
}

void AgentThread::run() {
    sleepPunctually();
    while (!stopping_.load()) {
        guarded([this] { step(); });
        // What is due waits for the next cycle where it has none.
        const std::chrono::nanoseconds untilDue{streams_.due() - monotonicNow()};
        const auto longest = std::min<std::chrono::nanoseconds>(
            longestWait + peers_.agents() * moreForEach, longestInCrowd);
        wait(std::clamp<std::chrono::nanoseconds>(untilDue, shortestWait, longest));
    }
    guarded([this] { leave(); });
    participant_.stopListening();
}

// Where somebody wants every cycle, the loop need not wake a thread that knows when it will have
// written.
void AgentThread::wait(std::chrono::nanoseconds limit) {
    const std::int64_t now = monotonicNow(), end = now + limit.count();
    const std::int64_t next = next_.load(std::memory_order_relaxed);
    const bool isExpected = now < next + lead && next <= end;
    if (isExpected && self_.access.period >= shortestExpected) awaitWrite(next);
    if (signals_.value() == seen_) signals_.sleepWhile(seen_, end);
    seen_ = signals_.value();
}

// Wakes up a little before that time and looks until a little after it. It yields, because the loop
// may need this very CPU.
void AgentThread::awaitWrite(std::int64_t time) {
    while (signals_.value() == seen_ && monotonicNow() < time - lead) {
        signals_.napWhile(seen_, time - lead);
    }
    while (signals_.value() == seen_ && monotonicNow() < time + lead) std::this_thread::yield();
}

// Whatever others send, this thread continues.
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
    const std::int64_t now = monotonicNow();
    if (std::exchange(newestCycle_, self_.access.newestCycle()) != self_.access.newestCycle()) {
        newCycleAt_ = now;
    }
    if (!silent_) streams_.step(now);
    takeMessages(now);
    reportRefusals();
    peers_.expire(now);
    if (peers_.takeChanged()) changed();
    if (links_.askAgain(now)) feed(now);
    commands_.step(now);
    calls_.step(peers_.all(), silent_);
    sendEvents();
    if (peers_.isSecond() != silent_) beSilent(!silent_);
    sendPresence(now);
    if (links_.anyUnbound() || peers_.missesAny(now)) participant_.announce();
}

void AgentThread::takeMessages(std::int64_t now) {
    received_.take(messages_);
    for (auto& [presence, came] : messages_.presences) {
        peers_.take(presence, came);
        if (presence.state != "stopping" && !peers_.isOther(presence.name, presence.epoch)) {
            commands_.heard(presence, came);
        }
    }
    for (auto& [model, came] : messages_.models) peers_.take(model, came);
    for (auto& [interest, came] : messages_.interests) peers_.take(interest, came);
    for (auto& [command, came] : messages_.commands) {
        if (silent_) continue;
        if (peers_.isOther(command.sender, command.senderEpoch)) {
            // It comes again, and is taken once that start counts.
            self_.rejections.add("a command of another start of " + command.sender);
        } else {
            commands_.take(command, now);
        }
    }
    for (auto& [answer, came] : messages_.answers) calls_.take(answer);
    messages_.presences.clear();
    messages_.models.clear();
    messages_.interests.clear();
    messages_.commands.clear();
    messages_.answers.clear();
}

// An answer that cannot be sent is dropped: the sender asks again.
void AgentThread::sendAnswer(const Answer& answer) {
    if (silent_) return;
    try {
        answers_.send(answer);
    } catch (const Error& error) {
        self_.rejections.add(error.what());
    }
}

void AgentThread::reportRefusals() {
    for (const std::string& each : participant_.takeRefusals()) {
        self_.event(Severity::Warning, self_.simplex, each);
    }
    for (const std::string& each : self_.rejections.takeReports(monotonicNow())) {
        self_.event(Severity::Warning, self_.simplex, each);
    }
}

std::map<std::string, std::uint64_t> AgentThread::rejections() const {
    auto counts = participant_.refusals();
    counts.merge(self_.rejections.byReason());
    return counts;
}

void AgentThread::changed() {
    links_.update(peers_.all());
    streams_.update(peers_.all());
    everyCycle_.store(streams_.everyCycle(), std::memory_order_relaxed);
    listenToOwners();
}

// Readers for lost owners are kept, for when they are back.
void AgentThread::listenToOwners() {
    const std::set<std::string> owners = links_.owners();
    for (const std::string& owner : owners) {
        std::unique_ptr<Reader<Block>>& reader = linksIn_[owner];
        if (reader) continue;
        reader = participant_.reader<Block>(
            topics::linkOf(owner), [this](Block&& block) { links_.take(block, monotonicNow()); });
    }
    if (linksIn_.size() <= owners.size() + mostLostOwners) return;
    std::erase_if(linksIn_, [&](const auto& each) { return !owners.contains(each.first); });
}

// An owner sends nothing: it may have forgotten what we want, or our reader may wait for numbers
// that somebody forged.
void AgentThread::feed(std::int64_t now) {
    const std::vector<std::string> starving = links_.takeStarving(peers_.all(), now);
    for (const std::string& owner : starving) linksIn_.erase(owner);
    if (!starving.empty()) listenToOwners();
    sendInterest();
}

void AgentThread::sendInterest() {
    if (interestOut_ && !silent_) interestOut_->write(links_.interest());
}

void AgentThread::sendEvents() {
    if (!events_.take(eventsToSend_)) signals_.advance();  // the next step follows at once
    for (const EventMessage& event : eventsToSend_) {
        if (!silent_ && eventOut_->write(event)) lastEvent_ = event.number;
    }
    eventsToSend_.clear();
}

Presence AgentThread::presence(const char* state) const {
    Presence presence = model_.presence(state, peers_.agents() + 1, lastEvent_);
    presence.interval = intervalAmong(presenceOut_->readers());
    presence.extras.insert(presence.extras.begin(),
                           {uptimeOfAgent, std::to_string(monotonicNow() - began_)});
    if (self_.access.realTime) addTimes(presence);
    addRefusals(presence);
    return presence;
}

// The rest of what was rejected() are datagrams.
void AgentThread::addRefusals(Presence& presence) const {
    const std::string datagrams = participant_.dropped();
    const std::uint64_t messages = self_.rejections.count() + participant_.malformed();
    if (!datagrams.empty()) presence.extras.push_back({droppedDatagrams, datagrams});
    if (messages == 0) return;
    const std::string last = self_.rejections.last().substr(0, longestReason);
    presence.extras.push_back(
        {refusedMessages, std::to_string(messages) + (last.empty() ? "" : ": " + last)});
}

// A loop that is stepped by hand has no time of its own.
void AgentThread::addTimes(Presence& presence) const {
    const std::int64_t now = monotonicNow();
    presence.extras.push_back({clockOfAgent, std::to_string(now)});
    presence.extras.push_back({ageOfLoop, std::to_string(now - newCycleAt_)});
    if (const LoopPace* pace = self_.access.pace; pace != nullptr && pace->rate() > 0) {
        presence.extras.push_back({rateOfLoop, std::to_string(std::llround(pace->rate() * 1000))});
        if (pace->overloaded()) presence.extras.push_back({overloaded, "1"});
    }
    const StandstillNote* note = self_.access.standstill;
    const auto found = note != nullptr ? note->get() : std::nullopt;
    if (!found) return;
    presence.extras.push_back({standstill, found->why});
    presence.extras.push_back({timeStood, std::to_string(now - found->since)});
}

void AgentThread::sendPresence(std::int64_t now) {
    if (now < presenceDue_) return;
    const Presence said = presence(silent_ ? "silent" : "running");
    presenceOut_->write(said);
    if (silent_)
        presenceDue_ = now + silentInterval;
    else
        presenceDue_ = std::max(presenceDue_ + said.interval, now + said.interval / 2);
}

// While another start of the name was there first, nothing is said but that. What others know of
// this start they keep.
void AgentThread::beSilent(bool silent) {
    silent_ = silent;
    presenceDue_ = 0;
    if (!silent) sendInterest();
}

// Leaves the network after the last cycle. A silent agent disposes of nothing, because the keys
// belong to the other start. The last presence is sent more than once: the end of the writer
// travels through another socket. Under load it overtakes the last sample, which best-effort
// readers do not get again.
void AgentThread::leave() {
    step();
    if (silent_) return;
    while (!events_.empty()) sendEvents();
    const Presence last = presence("stopping");
    for (int said = 1; said < timesStopping; ++said) {
        presenceOut_->write(last);
        std::this_thread::sleep_for(pauseStopping);
    }
    presenceOut_->write(last);
    presenceOut_->dispose(last);
}

}  // namespace cortex::comms
