// SPDX-License-Identifier: Apache-2.0
#include "agent/router.hpp"

#include "cortex/core/record.hpp"

#include "commands/command_port.hpp"

#include <algorithm>

namespace cortex {
namespace {

constexpr std::uint32_t knownSenders = 128;
constexpr const char* forgotten =
    "its time was over when it came, and whether it had run before is forgotten";
constexpr std::int64_t longestBudget = 3'600'000'000'000;  // ns: no record is kept for longer
constexpr std::int64_t longestWait = 450'000'000;          // ns for what is missing

std::int64_t periodOf(const AgentRuntime& runtime) {
    return std::max(runtime.options().period, std::int64_t{1});
}

std::uint32_t largest(const AgentRuntime& runtime, std::uint32_t CommandTable::* size) {
    std::uint32_t result = 8;
    for (std::uint32_t i = 0; i < runtime.structure().simplexes.size(); ++i) {
        result = std::max(result, runtime.commands(i).*size);
    }
    return result;
}

}  // namespace

Router::Router(AgentRuntime& runtime, std::span<Lane* const> toAgents)
    : runtime_{runtime},
      structure_{runtime.structure()},
      longestBudget_{longestBudget / periodOf(runtime)},
      longestWait_{(longestWait + periodOf(runtime) - 1) / periodOf(runtime)},
      keptForUrgent_{runtime.options().outsideCommands / 16},
      pool_(std::max(runtime.options().outsideCommands, 1U) + keptForUrgent_),
      ends_{largest(runtime, &CommandTable::maxResponse)},
      senders_{knownSenders, largest(runtime, &CommandTable::maxResponse)},
      leases_{runtime},
      links_{runtime},
      calls_{runtime, links_, toAgents} {
    const std::uint32_t request = largest(runtime, &CommandTable::maxRequest);
    const std::uint32_t response = largest(runtime, &CommandTable::maxResponse);
    records_.resize(pool_.size() * (request + response));
    for (std::size_t i = 0; i < pool_.size(); ++i) {
        pool_[i].request = &records_[i * (request + response)];
        pool_[i].response = pool_[i].request + request;
        free_.push_back(&pool_[pool_.size() - 1 - i]);
    }
    arrivals_.reserve(pool_.size());
    active_.reserve(pool_.size());
    taskless_.reserve(pool_.size());
    waits_.reserve(knownSenders);
    const auto answers = static_cast<std::uint32_t>(2 * pool_.size() + senderWindow);
    for (std::uint32_t i = 0; i < runtime.interfaces_.size(); ++i) {
        answers_.emplace_back(answers, response, calls_, i);
    }
    findStates();
    setControlHandlers();
}

void Router::read(std::span<CommunicationInterface* const> interfaces) {
    taskless_.clear();
    began_ = runtime_.thread(0).clock;
    Lease lost;
    while (leases_.takeExpired(cycle(), lost)) controlLost(lost, "it was not renewed for 2 s");
    for (interface_ = 0; interface_ < interfaces.size(); ++interface_) {
        interfaces[interface_]->read(*this);
    }
    links_.age();
    calls_.release();
    deliver();
}

void Router::command(const OutsideCommand& command) {
    std::uint32_t index = 0;
    if (!findSender(command, index)) return;
    SenderRecord& record = senders_[index];
    acknowledge(record, command.answeredBelow);
    if (command.sequence < record.answeredBelow) return repeatAcknowledged(command, record);
    if (command.sequence - record.answeredBelow >= senderWindow) {
        return refuse(command,
                      {Outcome::Rejected, Reason::Window, "too many of its sender are unanswered"});
    }
    KeptOutcome& kept = record.kept(command.sequence);
    if (kept.stage != Stage::Empty) return repeat(kept, command);
    Verdict verdict;
    judge(command, record, verdict);
    const bool good = verdict.outcome == Outcome::Done;
    if (good && isTooMuch(command, record)) return;  // it comes again
    kept.stage = good ? Stage::Waiting : Stage::Final;
    kept.sequence = command.sequence;
    kept.simplex = command.simplex;
    kept.command = command.command;
    kept.began = false;
    kept.size = 0;
    kept.answer = {};
    if (!command.refused) {
        record.lastNotAfter =
            std::max(record.lastNotAfter, std::min(command.notAfter, cycle() + longestBudget_));
    }
    if (good) return wait(command, index);
    record.goOn(record.next);
    kept.answer.outcome = verdict.outcome;
    kept.answer.reason = verdict.reason;
    kept.answer.why = *verdict.why;
    refuse(command, verdict);
}

// False: it is refused, because its sender does not count or this is another start of the agent.
bool Router::findSender(const OutsideCommand& command, std::uint32_t& record) {
    Verdict verdict{Outcome::Rejected, Reason::Restarted, {}};
    Sender before;
    auto found = SenderTable::Found::Older;
    if (command.targetEpoch != structure_.epoch) {
        verdict.why.emplace("it is meant for another start of this agent");
    } else {
        found = senders_.find(interface_, command.sender, cycle(), record, before);
        if (found == SenderTable::Found::Older) {
            senders_[record].refuse(command.sender.epoch, command.sequence);
            verdict.why.emplace("a later start of its sender is known");
        } else if (found == SenderTable::Found::NoRoom) {
            verdict.reason = Reason::Window;
            verdict.why.emplace("too many senders");
        }
    }
    if (verdict.why) return refuse(command, verdict), false;
    if (found == SenderTable::Found::Restarted) {
        refuseWaiting(senders_[record], Outcome::Expired, "its sender has started anew");
        senderLost(before);
    }
    return true;
}

// A late repeat needs no answer: its sender has it. Of a long command it may know only that it
// runs. But a number that never came was acknowledged by mistake, or by somebody who used the name
// of its sender.
void Router::repeatAcknowledged(const OutsideCommand& command, SenderRecord& sender) {
    if (sender.came(command.sequence)) return tellEnd(command);
    if (sender.unsure) return refuse(command, {Outcome::Unknown, Reason::None, forgotten});
    refuse(command, {Outcome::Rejected, Reason::Window,
                     "another command of its sender said that this one was answered"});
}

// Its sender asks what became of a long command that it knows to run.
void Router::tellEnd(const OutsideCommand& command) {
    const bool here = !command.refused && command.simplex < structure_.simplexes.size() &&
                      !structure_.simplexes[command.simplex].remote;
    if (!here || command.command >= runtime_.commands(command.simplex).entries.size()) return;
    const CommandTable::Entry& entry = runtime_.commands(command.simplex).entries[command.command];
    const bool isLong = entry.command != nullptr && entry.command->isLong;
    if (!isLong && !isLifeCycle(command.simplex, command.command)) return;
    OutsideAnswer end;
    if (ends_.find(interface_, command.sender, command.sequence, end)) {
        return answer(interface_, end);
    }
    const auto isIt = [&](const OutsideEntry* each) {
        return each->sequence == command.sequence && each->interface == interface_ &&
               each->sender.name == command.sender.name &&
               each->sender.epoch == command.sender.epoch;
    };
    const auto found = std::ranges::find_if(active_, isIt);
    if (found == active_.end()) {
        return refuse(command, {Outcome::Unknown, Reason::None, "how it ended is forgotten"});
    }
    if ((*found)->fresh || !(*found)->ran) return;  // it is answered in this cycle
    answer(interface_, {command.sender,
                        command.sequence,
                        command.simplex,
                        command.command,
                        Outcome::Running,
                        Reason::None,
                        {},
                        0,
                        0,
                        0,
                        nullptr});
}

// What needs no order. Leaves Done where the command may wait for its turn.
void Router::judge(const OutsideCommand& command, const SenderRecord& sender,
                   Verdict& verdict) const {
    const bool over = isOver(command.notAfter, command.until, began_);
    if (command.refused) {
        verdict = {Outcome::Rejected, Reason::None, "it was refused when it first came"};
    } else if (over && sender.unsure) {
        verdict = {Outcome::Unknown, Reason::None, forgotten};
    } else if (over) {
        verdict = {Outcome::Expired, Reason::None, "its time was over when it came"};
    } else if (command.notAfter - cycle() > longestBudget_) {
        verdict = {Outcome::Rejected, Reason::Range, "its time ends later than an hour from now"};
    } else if (command.simplex >= structure_.simplexes.size() ||
               structure_.simplexes[command.simplex].remote ||
               command.command >= runtime_.commands(command.simplex).entries.size()) {
        verdict = {Outcome::Rejected, Reason::UnknownCommand, "no such command here"};
    } else if (command.size !=
               runtime_.commands(command.simplex).entries[command.command].request.size) {
        verdict = {Outcome::Rejected, Reason::UnknownCommand, "its request has another size"};
    } else if (!hasRoom(command)) {
        verdict = {Outcome::MailboxFull, Reason::None, "too many commands are on their way"};
    }
}

OutsideEntry& Router::admit(const OutsideCommand& command, std::uint32_t record) {
    OutsideEntry& entry = *free_.back();
    free_.pop_back();
    entry.sender = command.sender;
    entry.onBehalfOf = command.onBehalfOf;
    entry.sequence = command.sequence;
    entry.notAfter = command.notAfter;
    entry.until = command.until;
    entry.interface = interface_;
    entry.senderRecord = record;
    entry.simplex = command.simplex;
    entry.command = command.command;
    entry.readCycle = cycle();
    entry.readTime = runtime_.thread(0).clock.nanoseconds;
    entry.answer = {};
    entry.answer.outcome = Outcome::Running;
    entry.fresh = false;
    entry.ran = false;
    entry.queued = false;
    entry.withdrawnBy = {};
    entry.watched = LifeCycle::None;
    entry.moved = false;
    std::copy_n(command.request, command.size, entry.request);
    return entry;
}

void Router::repeat(const KeptOutcome& kept, const OutsideCommand& command) {
    if (kept.stage == Stage::Waiting || kept.stage == Stage::OnItsWay) return;  // answered later
    if (command.refused) return;
    answer(interface_, {command.sender, kept.sequence, kept.simplex, kept.command,
                        kept.answer.outcome, kept.answer.reason, kept.answer.why,
                        kept.answer.latencyCycles, kept.answer.latency, kept.size, kept.response});
}

void Router::refuse(const OutsideCommand& command, const Verdict& verdict) {
    if (command.refused) return;  // its transport has answered
    AnswerHead head;
    head.outcome = verdict.outcome;
    head.reason = verdict.reason;
    head.why = *verdict.why;
    ++runtime_.thread(0).rejected;
    report(command, head);
    answer(interface_, {command.sender, command.sequence, command.simplex, command.command,
                        head.outcome, head.reason, head.why, 0, 0, 0, nullptr});
}

// In canonical order: whatever the order in which interfaces handed them over.
void Router::deliver() {
    deliverWaiting();
    std::ranges::sort(arrivals_, [](const auto* a, const auto* b) { return a->before(*b); });
    for (OutsideEntry* entry : arrivals_) {
        active_.push_back(entry);
        if (isLifeCycle(*entry)) {
            deliverLifeCycle(*entry);
            continue;
        }
        runtime_.ports_[entry->simplex]->enqueue(*entry);
        const bool hasTask = structure_.simplexes[entry->simplex].role == Role::Active;
        if (!hasTask && (taskless_.empty() || taskless_.back() != entry->simplex)) {
            taskless_.push_back(entry->simplex);
        }
    }
    arrivals_.clear();
}

void Router::collect() {
    for (OutsideEntry* entry : active_) {
        if (entry->watched != LifeCycle::None) watch(*entry);
        if (entry->fresh) publish(*entry);
    }
    std::erase_if(active_, [](const OutsideEntry* entry) { return entry->simplex == noSimplex; });
}

void Router::publish(OutsideEntry& entry) {
    const AnswerHead& head = entry.answer;
    const auto& layout = runtime_.commands(entry.simplex).entries[entry.command].response;
    const std::uint32_t size = head.outcome == Outcome::Done ? layout.size : 0;
    SenderRecord& record = senders_[entry.senderRecord];
    KeptOutcome& kept = record.kept(entry.sequence);
    const bool known =
        record.sender.name == entry.sender.name && record.sender.epoch == entry.sender.epoch;
    entry.fresh = false;
    if (known && kept.sequence == entry.sequence && kept.stage != Stage::Empty) {
        kept.stage = entry.final() ? Stage::Final : Stage::Running;
        kept.began = kept.began && head.outcome != Outcome::Expired;
        kept.answer = head;
        kept.size = size;
        std::copy_n(entry.response, size, kept.response);
    }
    const OutsideAnswer message{entry.sender, entry.sequence, entry.simplex, entry.command,
                                head.outcome, head.reason,    head.why,      head.latencyCycles,
                                head.latency, size,           entry.response};
    answer(entry.interface, message);
    if (!entry.final()) {
        entry.ran = true;
        return;
    }
    if (entry.ran) ends_.keep(entry.interface, message);
    report(messageOf(entry), head);
    if (known) --record.onTheirWay;
    release(entry);
}

void Router::release(OutsideEntry& entry) {
    entry.simplex = noSimplex;
    free_.push_back(&entry);
}

void Router::answer(std::uint32_t interface, const OutsideAnswer& answer) {
    if (answers_[interface].push(answer)) return;
    event(Severity::Warning, EventKind::Command, noSimplex,
          EventText{"an answer to "} << answer.sender.nameText() << " was dropped: too many");
}

void Router::write(std::span<CommunicationInterface* const> interfaces) {
    calls_.expire();
    for (std::uint32_t i = 0; i < interfaces.size(); ++i)
        interfaces[i]->write(cycle(), answers_[i]);
}

void Router::stop() {
    for (const std::uint32_t record : waits_) {
        refuseWaiting(senders_[record], Outcome::Cancelled, "the agent stopped");
    }
    for (OutsideEntry* entry : active_) {
        if (!entry->fresh) {
            entry->settle({Outcome::Cancelled, Reason::None, "the agent stopped"},
                          runtime_.thread(0).clock);
        }
        entry->watched = LifeCycle::None;
    }
    collect();
}

}  // namespace cortex
