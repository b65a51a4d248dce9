// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_thread.hpp"

#include "cortex/core/clock.hpp"
#include "cortex/core/error.hpp"
#include "cortex/core/service_threads.hpp"

#include "security/security_identity.hpp"
#include "wire/presence_extras.hpp"
#include "wire/presence_interval.hpp"

#include <algorithm>
#include <chrono>
#include <concepts>
#include <cstddef>
#include <exception>
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
constexpr std::chrono::milliseconds pauseStanding{5};
constexpr std::int64_t quietWhenMet = 100'000'000;  // ns without anybody new

// Commands and answers are urgent. Everything else waits for the next step.
template <class Message>
constexpr bool isUrgent = std::same_as<Message, Command> || std::same_as<Message, Answer>;

// Null: without security.
const AgentRights* rightsOf(const Participant& participant) {
    const SecurityIdentity* identity = participant.identity();
    return identity != nullptr ? &identity->folder().rights : nullptr;
}

}  // namespace

AgentThread::AgentThread(const AgentAccess& agent, const NetworkOptions& options)
    : self_{agent},
      network_{self_, options},
      model_{self_, options.security.empty() ? "" : securityOn},
      participant_{network_.options(), self_.name, Participant::Speaks::WhenTold},
      events_{self_},
      answers_{participant_},
      rivals_{self_, rightsOf(participant_)},
      commands_{self_, [this](const Answer& answer) { sendAnswer(answer); },
                participant_.identity(), &rivals_},
      links_{self_},
      streams_{self_, model_.structureHash(), participant_},
      summary_{self_, model_.structureHash(), participant_},
      past_{self_, participant_},
      values_{self_},
      calls_{self_, links_, participant_},
      peers_{self_,
             [this](const std::string& name, std::int64_t epoch) { commands_.lost(name, epoch); },
             participant_.identity()} {
    if (const AgentRights* rights = rightsOf(participant_)) {
        requireOwned(self_.structure(), *rights);
        model_.show(participant_.identity()->folder().commands);
    }
    makeEndpoints();
    const ServiceThreads named{"cortex-comms"};
    thread_ = std::thread{[this] { run(); }};
    if (options.onSecondStart == OnSecondStart::Silent) return;
    try {
        awaitStanding(options);
    } catch (...) {
        stopping_.store(true);
        signals_.wake();
        thread_.join();
        throw;
    }
}

void AgentThread::makeEndpoints() {
    presenceOut_ = participant_.writer<Presence>(topics::presence);
    modelOut_ = participant_.writer<Model>(topics::model);
    eventOut_ = participant_.writer<EventMessage>(topics::event);
    if (links_.any()) interestOut_ = participant_.writer<Interest>(topics::interest);
    presenceIn_ = receive<Presence>({topics::presence.name, Qos::Cycle});  // the next comes soon
    if (links_.any()) modelIn_ = receive<Model>(topics::model);
    interestIn_ = receive<Interest>(topics::interest);
    commandIn_ = receive<Command>(topics::command);
    if (calls_.any()) answerIn_ = receive<Answer>(topics::answerTo(self_.name));
    for (const Model& sample : model_.samples()) modelOut_->write(sample);
    sendInterest();
    participant_.speak();
}

// Endpoints of DDS keep the addresses with which they were made. Whoever joins from now on gets the
// events from now on.
void AgentThread::joinAnew() {
    Participant next{network_.options(), self_.name, Participant::Speaks::WhenTold};
    participant_.stopListening();
    answers_.renew();
    streams_.renew();
    summary_.renew();
    past_.renew();
    calls_.leave();
    linksIn_.clear();
    answerIn_.reset();
    commandIn_.reset();
    interestIn_.reset();
    modelIn_.reset();
    presenceIn_.reset();
    interestOut_.reset();
    eventOut_.reset();
    modelOut_.reset();
    presenceOut_.reset();
    {
        const std::lock_guard lock{joining_};
        participant_.replaceBy(std::move(next));
    }
    calls_.join();
    makeEndpoints();
    changed();
    presenceDue_ = 0;
}

// The thread of the program waits here, before anything else of the agent begins.
void AgentThread::awaitStanding(const NetworkOptions& options) {
    while (standing_.load() == Standing::Unknown) std::this_thread::sleep_for(pauseStanding);
    if (!isSecond()) return;
    const std::string other = "another start of " + self_.name + " is there";
    if (options.onSecondStart == OnSecondStart::Refused) throw SecondStart{other};
    const auto ended = [this] { return !isSecond(); };
    if (options.waitForFirst && !options.waitForFirst(ended)) {
        throw SecondStart{other + ", and this one was stopped before it ended"};
    }
    while (!ended()) std::this_thread::sleep_for(pauseStanding);
}

// Once everybody who was found has said who it is, it is known whether our name is free.
void AgentThread::meet(std::int64_t now) {
    if (peers_.isSecond()) return standing_.store(Standing::Second);
    if (standing_.load() != Standing::Unknown) return standing_.store(Standing::First);
    const std::uint32_t found = presenceIn_->writers() + participant_.pending();
    if (std::exchange(found_, found) != found || foundAt_ == 0) foundAt_ = now;
    const bool known = peers_.heard() >= found && now - foundAt_ >= quietWhenMet;
    if (known || now - self_.began >= timeToMeet) standing_.store(Standing::First);
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
    if (!silent_) summary_.step(now);
    if (!silent_) values_.step(now);
    peers_.look(now);
    takeMessages(now);
    reportRefusals();
    peers_.expire(now);
    if (peers_.takeChanged()) changed();
    meet(now);
    const std::uint32_t others = peers_.agents() + (silent_ ? 1 : 0);
    const bool moved = network_.look(others, links_.anyUnbound(), now);
    const bool isDeaf = presenceIn_->isDeaf(), hearsAny = peers_.heard() > 1 && !isDeaf;
    if (rejoin_.isDue(hearsAny, participant_.findsUnproven() || isDeaf, now) || moved) {
        if (isDeaf)
            self_.event(Severity::Warning, self_.simplex,
                        "somebody wrote in the name of others, so what these write is skipped; the "
                        "network is joined anew",
                        EventKind::Loss);
        joinAnew();
    }
    if (links_.askAgain(now)) feed(now);
    if (links_.anyUnbound()) {
        const std::uint32_t found = presenceIn_->writers() + participant_.pending();
        links_.tellMisspelt(peers_.all(), peers_.heard() < found, now);
    }
    commands_.step(now);
    calls_.step(peers_.all(), silent_);
    if (!silent_) past_.step(now);
    sendEvents();
    if (peers_.isSecond() != silent_) beSilent(!silent_);
    sendPresence(now);
    if (links_.anyUnbound() || peers_.missesAny(now) || peers_.takeStood()) participant_.announce();
}

void AgentThread::takeMessages(std::int64_t now) {
    received_.take(messages_);
    for (auto& [presence, came] : messages_.presences) {
        peers_.take(presence, came);
        if (presence.state != "stopping" && !peers_.isOther(presence.name, presence.epoch)) {
            commands_.heard(presence, came);
            past_.take(presence, came);
            if (!silent_ && numberIn(presence, commandsOthers) != 0) {
                answers_.prepare(presence.name);
            }
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
    const std::lock_guard lock{joining_};
    auto counts = self_.rejections.byReason();
    for (const auto& [reason, refused] : participant_.refusals()) counts[reason] += refused.count;
    return counts;
}

void AgentThread::changed() {
    rivals_.update(peers_.all());
    if (!modelIn_ && rivals_.needsModels(peers_.all())) modelIn_ = receive<Model>(topics::model);
    links_.update(peers_.all());
    streams_.update(peers_.all());
    summary_.update(peers_.all());
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

}  // namespace cortex::comms
