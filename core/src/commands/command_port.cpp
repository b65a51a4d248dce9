// SPDX-License-Identifier: Apache-2.0
#include "commands/command_port.hpp"

#include "cortex/core/argument_checks.hpp"

#include "commands/safe_refusal.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace cortex {
namespace {

Origin originOf(Lane* lane, OutsideEntry* outside) {
    if (lane == nullptr) return {nullptr, 0, 0, outside, outside->readCycle, outside->readTime};
    const LaneSlot& head = lane->front();
    return {lane, lane->number(), head.handle, nullptr, head.cycles, head.time};
}

Verdict shortVerdict(Outcome outcome, const Call& call, const CommandTable::Entry& entry,
                     std::byte* response) {
    if (outcome == Outcome::Done) return doneVerdict(entry, response);
    if (outcome == Outcome::Running) {
        return {Outcome::Failed, Reason::None, "only a long command may go on running"};
    }
    return verdictOf(outcome, call);
}

void refuse(Verdict& verdict, Reason reason, const EventText& why) {
    verdict = {Outcome::Rejected, reason, why};
}

constexpr const char* hookThrew = "one of its hooks threw: clearFaults comes first";

}  // namespace

EventText stateRefusal(std::string_view what, StateSet needs, State state) {
    EventText text{what};
    text << (needs.empty() ? " is never available" : " needs ");
    bool first = true;
    for (int i = 0; i < stateCount; ++i) {
        if (!needs.has(static_cast<State>(i))) continue;
        text << (first ? "" : " or ") << name(static_cast<State>(i));
        first = false;
    }
    return text << ", is " << name(state);
}

CommandPort::CommandPort(const PortAccess& agent, std::uint32_t simplex, const CommandTable& table)
    : thread_{&agent.loop},
      table_{table},
      stateless_{agent.structure.simplexes[simplex].role != Role::Active},
      handlers_{std::make_unique<Handler[]>(table.entries.size())},
      agent_{agent},
      simplex_{simplex} {
    if (table.hasLong) activity_ = std::make_unique<Activity>(agent, simplex, table);
    const TypeLayout& layout = *agent.structure.simplexes[simplex].layout;
    for (std::size_t i = 0; i < table.settable.size(); ++i) {
        const DataItem& item = *table.settable[i];
        void* cell = agent.tables.live(simplex).at(item.kind, layout.find(item.name)->offset);
        settables_.push_back({&table.entries.back().checks[i], cell});
    }
}

void CommandPort::addReceiving(Lane& lane) {
    if (receiving_ == nullptr)
        receiving_ = &lane;
    else
        moreReceiving_.push_back(&lane);
    more_ = more_ || !moreReceiving_.empty();
    callFor(true);
}

void CommandPort::addSending(Lane& lane) {
    if (sending_ == nullptr)
        sending_ = &lane;
    else
        moreSending_.push_back(&lane);
    more_ = more_ || !moreSending_.empty();
    callFor(true);
}

void CommandPort::callFor(bool work) {
    if (work)
        agent_.calls.fetch_or(commandWork, std::memory_order_relaxed);
    else
        agent_.calls.fetch_and(static_cast<std::uint8_t>(~commandWork), std::memory_order_relaxed);
}

// Beyond lanes, which always have.
bool CommandPort::hasPassingWork() const {
    return outside_ != nullptr || (activity_ != nullptr && activity_->running());
}

// Nearly every command: short, accepted, Done. False: nothing has happened yet.
[[gnu::always_inline]] inline bool CommandPort::takeOnFastPath(Lane& lane) {
    LaneSlot& head = lane.front();
    const CommandTable::Entry& entry = table_.entries[head.command];
    const std::byte* request = lane.requestOf(head);
    if (!entry.isShort || dead_ || !entry.available.has(state_)) return false;
    for (const ArgumentCheck& check : entry.checks) {
        if (!isOneNumberInRange(check, request)) return false;
    }
    const Handler& handler = handlerOf(head.command);
    if (handler.function == nullptr) return false;
    std::byte* response = lane.responseOf(head);
    copyRecord(response, entry.emptyResponse.data(), entry.response.size);
    Call call{request, response};
    call.setTime(thread_->nominalTime, thread_->nominalTime);
    const Outcome outcome = handler(call);
    const bool isDone = outcome == Outcome::Done &&
                        (entry.floats.empty() || notFinite(entry.floats, response) == nullptr);
    if (isDone) [[likely]] {
        lane.answerDone(head, thread_->clock);
        countExecuted(head.time);
    } else {
        answer(lane, head, shortVerdict(outcome, call, entry, response));
    }
    return true;
}

// A handler cannot add to the lane that it is called from: its sender is another.
[[gnu::always_inline]] inline void CommandPort::drain(Lane& lane) {
    try {
        for (std::int32_t left = lane.pending(thread_->clock.cycle); left > 0; --left) {
            if (!takeOnFastPath(lane)) take(lane);
        }
    } catch (...) {
        answer(lane, lane.front(), {Outcome::Failed, Reason::None, "its handler threw"});
        throw;
    }
}

void CommandPort::process(State state, LoopThread& thread, bool dead) {
    if (thread_ != &thread) thread_ = &thread;
    if (state_ != state) state_ = state;
    if (dead_ != dead) dead_ = dead;
    if (more_) return processAll();
    const std::int64_t cycle = thread.clock.cycle;
    if (sending_ != nullptr) {
        sending_->beginSending(cycle);
        sending_->takeAnswers(cycle);
    }
    if (receiving_ != nullptr) {
        receiving_->beginReceiving(cycle);
        drain(*receiving_);
    }
}

void CommandPort::beginLanes() {
    const std::int64_t cycle = thread_->clock.cycle;
    if (sending_ != nullptr) sending_->beginSending(cycle);
    for (Lane* lane : moreSending_) lane->beginSending(cycle);
    if (receiving_ != nullptr) receiving_->beginReceiving(cycle);
    for (Lane* lane : moreReceiving_) lane->beginReceiving(cycle);
}

void CommandPort::processAll() {
    startedNow_ = false;
    beginLanes();
    const std::int64_t cycle = thread_->clock.cycle;
    if (sending_ != nullptr) sending_->takeAnswers(cycle);
    for (Lane* lane : moreSending_) lane->takeAnswers(cycle);
    auto next = moreReceiving_.begin();
    for (Lane* lane = receiving_; lane != nullptr;
         lane = next == moreReceiving_.end() ? nullptr : *next++) {
        drain(*lane);
    }
    if (outside_ != nullptr) drainOutside();
    if (activity_ != nullptr && activity_->running()) stepActivity();
    more_ = !moreSending_.empty() || !moreReceiving_.empty() || hasPassingWork();
    if (sending_ == nullptr && receiving_ == nullptr && !hasPassingWork()) callFor(false);
}

void CommandPort::take(Lane& lane) {
    LaneSlot& head = lane.front();
    Verdict verdict;
    execute(head.command, lane.requestOf(head), lane.responseOf(head), &lane, nullptr, verdict);
    answer(lane, head, verdict);
}

void CommandPort::answer(Lane& lane, LaneSlot& head, const Verdict& verdict) {
    lane.answer(head, verdict, thread_->clock);
    count(verdict, head.time);
    if (lane.startsRefusing(!verdict.good())) {
        EventText text{table_.entries[head.command].name};
        text << " from " << agent_.structure.simplexes[lane.shape().sender].path << ": "
             << name(verdict.outcome);
        if (verdict.why) text << ", " << verdict.why->view();
        agent_.present.post(*thread_, Severity::Warning, EventKind::Refusal, simplex_, text);
    }
    lane.pop();
}

void CommandPort::drainOutside() {
    while (outside_ != nullptr) {
        OutsideEntry& entry = *outside_;
        outside_ = entry.next;
        entry.queued = false;
        Verdict verdict;
        if (!entry.withdrawnBy.empty()) {
            EventText why{"withdrawn by a later "};
            verdict = {Outcome::Expired, Reason::None,
                       why << entry.withdrawnBy << " of its sender"};
        } else if (isOver(entry.notAfter, entry.until, thread_->clock)) {
            verdict = {Outcome::Expired, Reason::None, "its time was over before its turn"};
        } else {
            try {
                execute(entry.command, entry.request, entry.response, nullptr, &entry, verdict);
            } catch (...) {
                verdict = {Outcome::Failed, Reason::None, "its handler threw"};
                entry.settle(verdict, thread_->clock);
                count(verdict, entry.answer.latency);
                throw;
            }
        }
        entry.settle(verdict, thread_->clock);
        count(verdict, entry.answer.latency);
    }
}

void CommandPort::execute(std::uint32_t command, const std::byte* request, std::byte* response,
                          Lane* lane, OutsideEntry* outside, Verdict& verdict) {
    const CommandTable::Entry& entry = table_.entries[command];
    if (entry.command == nullptr) {
        if (entry.name == "set")
            set(request, verdict);
        else
            cancel(verdict);
        return;
    }
    copyRecord(response, entry.emptyResponse.data(), entry.response.size);
    if (!accepted(entry, request, verdict)) return;
    const Handler& handler = handlerOf(command);
    if (handler.function == nullptr) {
        refuse(verdict, Reason::UnknownCommand, EventText{entry.name} << " has no handler");
        return;
    }
    if (!entry.isShort) {
        startActivity(command, request, response, originOf(lane, outside), verdict);
        return;
    }
    Call call{request, response};
    call.setTime(thread_->nominalTime, thread_->nominalTime);
    if (outside != nullptr) outside->tellOrigin(call);
    verdict = shortVerdict(handler(call), call, entry, response);
}

bool CommandPort::accepted(const CommandTable::Entry& entry, const std::byte* request,
                           Verdict& verdict) {
    if (!entry.available.has(state_)) {
        refuse(verdict, Reason::State, stateRefusal(entry.name, entry.available, state_));
        return false;
    }
    if (dead_) {
        refuse(verdict, Reason::State, hookThrew);
        return false;
    }
    for (const ArgumentCheck& check : entry.checks) {
        if (checkArgument(check, request, verdict.why)) continue;
        verdict.outcome = Outcome::Rejected;
        verdict.reason = Reason::Range;
        return false;
    }
    return true;
}

void CommandPort::startActivity(std::uint32_t command, const std::byte* request,
                                std::byte* response, const Origin& origin, Verdict& verdict) {
    const CommandTable::Entry& entry = table_.entries[command];
    if (!activity_->mayRun(entry)) {
        refuse(verdict, Reason::State, activity_->inputLost());
        return;
    }
    if (activity_->running()) {
        if (entry.command->onBusy == OnBusy::Reject) {
            refuse(verdict, Reason::Busy, EventText{activity_->command()} << " is running");
            return;
        }
        activity_->cancel(thread_->clock, true, "replaced by a newer request");
    }
    startedNow_ = true;
    more_ = true;
    cancelWhy_ = nullptr;
    activity_->start(entry, handlers_[command], request, origin, verdict);
    copyRecord(response, activity_->response(), entry.response.size);
}

void CommandPort::cancel(Verdict& verdict) {
    if (!activity_->running()) {
        refuse(verdict, Reason::State, "no long command is running");
        return;
    }
    activity_->cancel(thread_->clock, true, "cancelled by a command");
}

// All or nothing: everything is checked before anything is written.
void CommandPort::set(const std::byte* request, Verdict& verdict) {
    bool any = false;
    for (std::size_t i = 0; i < settables_.size(); ++i) {
        if (request[i] == std::byte{0}) continue;
        if (!settable(settables_[i], request, verdict)) return;
        any = true;
    }
    if (!any) {
        refuse(verdict, Reason::Range, "set names no item");
        return;
    }
    if (dead_) {
        refuse(verdict, Reason::State, hookThrew);
        return;
    }
    if (settingsHooks_.object != nullptr && !agreed(request, verdict)) return;
    for (std::size_t i = 0; i < settables_.size(); ++i) {
        if (request[i] != std::byte{0}) settables_[i].store(request);
    }
    if (settingsHooks_.object != nullptr) settingsHooks_.changed(settingsHooks_.object);
}

// What the simplex itself says of values that are right one by one.
bool CommandPort::agreed(const std::byte* request, Verdict& verdict) const {
    ProposedSettings proposed{settables_, request};
    settingsHooks_.proposed(settingsHooks_.object, proposed);
    if (!proposed.refusal()) return true;
    refuse(verdict, Reason::Range, *proposed.refusal());
    return false;
}

bool CommandPort::settable(const SettableItem& target, const std::byte* request,
                           Verdict& verdict) const {
    const DataItem& item = *target.check->item;
    if (!stateless_ && !item.settable.has(state_)) {
        refuse(verdict, Reason::State, stateRefusal(item.name, item.settable, state_));
        return false;
    }
    if (const auto safe = safeRefusal(agent_.structure, agent_.tables, simplex_, item)) {
        refuse(verdict, Reason::State, *safe);
        return false;
    }
    if (checkArgument(*target.check, request, verdict.why)) return true;
    verdict.outcome = Outcome::Rejected;
    verdict.reason = Reason::Range;
    return false;
}

void CommandPort::stepActivity() {
    if (startedNow_) return;
    if (cancelWhy_ != nullptr) {
        activity_->cancel(thread_->clock, true, std::exchange(cancelWhy_, nullptr));
        return;
    }
    activity_->step(thread_->clock);
}

bool CommandPort::cancelActivity(LoopThread& thread, bool callHandler, std::string_view why) {
    if (activity_ == nullptr || !activity_->running()) return true;
    thread_ = &thread;
    beginLanes();  // the handler may send
    try {
        activity_->cancel(thread.clock, callHandler, why);
    } catch (...) {
        agent_.present.post(thread, Severity::Error, EventKind::Fault, simplex_,
                            "the handler of its long command threw while it was cancelled");
        return false;
    }
    return true;
}

void CommandPort::loseInput(LoopThread& thread, const EventText& why) {
    if (activity_ == nullptr) return;
    thread_ = &thread;
    beginLanes();  // the handler may send
    activity_->loseInput(thread.clock, why);
}

void CommandPort::regainInput() {
    if (activity_ != nullptr) activity_->regainInput();
}

void CommandPort::enqueue(OutsideEntry& entry) {
    OutsideEntry** place = &outside_;
    while (*place != nullptr && (*place)->before(entry)) place = &(*place)->next;
    entry.next = *place;
    *place = &entry;
    more_ = true;
    callFor(true);
}

const OutsideEntry* CommandPort::activityOrigin() const {
    return activity_ != nullptr && activity_->running() ? activity_->origin().outside : nullptr;
}

void CommandPort::count(const Verdict& verdict, std::int64_t latency) {
    if (verdict.outcome == Outcome::Rejected || verdict.outcome == Outcome::Expired)
        ++thread_->rejected;
    else
        countExecuted(latency);
}

Outcome CommandPort::notSent(CommandSender::State& state, Outcome outcome, std::string_view why) {
    ++thread_->rejected;
    state.answer.outcome = outcome;
    if (!state.notSent) {
        state.notSent = true;
        const std::uint32_t receiver = state.lane->shape().receiver;
        EventText text{state.table->entries[state.command].name};
        text << " to " << agent_.structure.simplexes[receiver].path << ": " << why << ", not sent";
        agent_.present.post(*thread_, Severity::Warning, EventKind::Refusal, simplex_, text);
    }
    return outcome;
}

}  // namespace cortex
