// SPDX-License-Identifier: Apache-2.0
// The commands of one sender to one simplex begin in the order of sending. Its numbers have no
// gaps, so a command waits until all below it have come, for a limited time. What comes after that
// is refused if a later one to the same simplex has begun. A command to the agent itself counts as
// one to each of its simplexes.
#include "cortex/core/control_commands.hpp"

#include "agent/router.hpp"

#include <algorithm>

namespace cortex {

// What stops something waits for nothing, and needs no control.
bool Router::isUrgent(std::uint32_t simplex, std::uint32_t command) const {
    return isUrgentCommand(runtime_.commands(simplex).entries[command].name);
}

bool Router::hasRoom(const OutsideCommand& command) const {
    return free_.size() > (isUrgent(command.simplex, command.command) ? 0 : keptForUrgent_);
}

bool Router::concernEachOther(std::uint32_t simplex, std::uint32_t other) const {
    const std::uint32_t all = runtime_.agentSimplex();
    return simplex == other || simplex == all || other == all;
}

// At most half the pool waits: the rest is for what is missing. Only commands behind a gap count.
bool Router::isTooMuch(const OutsideCommand& command, const SenderRecord& sender) const {
    return command.sequence > sender.next && waiting_ >= pool_.size() / 2 &&
           !isUrgent(command.simplex, command.command);
}

// Its sender waits no longer for what is below: what has not begun does not run any more.
void Router::acknowledge(SenderRecord& sender, std::uint64_t below) {
    while (sender.waiting != nullptr && sender.waiting->sequence < below) {
        OutsideEntry& entry = sender.takeFirst();
        entry.settle({Outcome::Expired, Reason::None, "its sender gave it up"},
                     runtime_.thread(0).clock);
        sender.kept(entry.sequence).stage = Stage::Empty;
        --sender.onTheirWay;
        report(messageOf(entry), entry.answer);
        release(entry);
    }
    sender.acknowledge(below);
}

void Router::wait(const OutsideCommand& command, std::uint32_t record) {
    SenderRecord& sender = senders_[record];
    if (command.sequence > sender.next) ++waiting_;
    OutsideEntry& entry = admit(command, record);
    entry.waitUntil = cycle() + patienceWith(command);
    sender.insert(entry);
    sender.goOn(sender.next);
    if (!sender.listed) waits_.push_back(record);
    sender.listed = true;
}

// Cycles. No command expires because it waits: at least half of its time is left.
std::int64_t Router::patienceWith(const OutsideCommand& command) const {
    if (isUrgent(command.simplex, command.command)) return 0;
    const std::int64_t period = std::max(runtime_.options().period, std::int64_t{1});
    std::int64_t left = command.notAfter - cycle();
    if (command.until != 0) {
        left = std::min(left, (command.until - began_.nanoseconds) / period);
    }
    return std::min(longestWait_, left / 2);
}

void Router::deliverWaiting() {
    waiting_ = 0;
    takesControl_ = false;
    for (const std::uint32_t record : waits_) deliverWaitingOf(senders_[record]);
    std::erase_if(waits_, [this](std::uint32_t record) {
        SenderRecord& sender = senders_[record];
        sender.listed = sender.waiting != nullptr;
        return !sender.listed;
    });
}

void Router::deliverWaitingOf(SenderRecord& sender) {
    std::uint64_t due = 0;  // what has waited long enough takes all below it along
    for (const OutsideEntry* each = sender.waiting; each != nullptr; each = each->next) {
        if (cycle() >= each->waitUntil) due = each->sequence;
    }
    while (sender.waiting != nullptr) {
        OutsideEntry& first = *sender.waiting;
        const bool isDue = first.sequence <= due;
        if (!isDue && (first.sequence > sender.next || mustLetGo(first))) break;
        sender.takeFirst();
        sender.goOn(first.sequence + 1);
        Verdict verdict;
        judgeTurn(first, sender, verdict);
        if (verdict.outcome != Outcome::Done) {
            ++runtime_.thread(0).rejected;
            first.settle(verdict, runtime_.thread(0).clock);
            publish(first);
            continue;
        }
        begin(first, sender);
    }
    for (const OutsideEntry* each = sender.waiting; each != nullptr; each = each->next) ++waiting_;
}

void Router::begin(OutsideEntry& entry, SenderRecord& sender) {
    const bool renewal = isRenewal(entry.simplex, entry.command);
    KeptOutcome& kept = sender.kept(entry.sequence);
    kept.stage = Stage::OnItsWay;
    kept.began = !renewal;  // otherwise each would overtake what comes late
    if (kept.began) sender.newest = std::max(sender.newest, entry.sequence);
    entry.queued = !isLifeCycle(entry);
    takesControl_ = takesControl_ || (isControl(entry.simplex, entry.command) && !renewal);
    withdrawEarlier(entry);
    arrivals_.push_back(&entry);
}

// Leaves Done where it may begin. Control is judged now: what gives it may have waited as well.
void Router::judgeTurn(const OutsideEntry& entry, const SenderRecord& sender,
                       Verdict& verdict) const {
    if (isOvertaken(entry, sender)) {
        verdict = {Outcome::Expired, Reason::None,
                   "a later command of its sender to this simplex has begun; it came too late"};
    } else if (isOver(entry.notAfter, entry.until, began_)) {
        verdict = {Outcome::Expired, Reason::None, "its time was over before its turn"};
    } else {
        authorise(entry, verdict);
    }
}

// The window has all numbers that can be later.
bool Router::isOvertaken(const OutsideEntry& entry, const SenderRecord& sender) const {
    if (entry.sequence > sender.newest) return false;
    return std::ranges::any_of(sender.window, [&](const KeptOutcome& kept) {
        return kept.began && kept.sequence > entry.sequence &&
               concernEachOther(kept.simplex, entry.simplex);
    });
}

// Life-cycle commands act before the tasks, and so do all to the agent. Renewals of control have no
// order.
bool Router::actsFirst(const OutsideEntry& entry) const {
    if (isRenewal(entry.simplex, entry.command)) return false;
    return entry.simplex == runtime_.agentSimplex() || isLifeCycle(entry);
}

// `entry` acts first; `earlier` may stand in the queue of a simplex.
bool Router::wouldOvertake(const OutsideEntry& entry, const OutsideEntry& earlier) const {
    if (!earlier.queued || !earlier.earlier(entry) || isRenewal(earlier.simplex, earlier.command)) {
        return false;
    }
    const bool sameQueue = entry.simplex == earlier.simplex && !isLifeCycle(entry);
    return !sameQueue && concernEachOther(entry.simplex, earlier.simplex);
}

// Whether it waits for an earlier one in a queue: one that it would overtake, or that may give it
// control in this cycle.
bool Router::mustLetGo(const OutsideEntry& entry) const {
    const auto givesControl = [&](const OutsideEntry* each) {
        return each->queued && isControl(each->simplex, each->command) &&
               !isRenewal(each->simplex, each->command) && each->earlier(entry);
    };
    if (takesControl_ && !isControl(entry.simplex, entry.command) &&
        std::ranges::any_of(arrivals_, givesControl)) {
        return true;
    }
    const auto holdsUp = [&](const OutsideEntry* each) { return wouldOvertake(entry, *each); };
    return actsFirst(entry) &&
           (std::ranges::any_of(arrivals_, holdsUp) || std::ranges::any_of(active_, holdsUp));
}

void Router::withdrawEarlier(const OutsideEntry& entry) {
    if (!actsFirst(entry)) return;
    const std::string_view by = runtime_.commands(entry.simplex).entries[entry.command].name;
    const auto withdraw = [&](OutsideEntry* each) {
        if (each->withdrawnBy.empty() && wouldOvertake(entry, *each)) each->withdrawnBy = by;
    };
    std::ranges::for_each(arrivals_, withdraw);
    std::ranges::for_each(active_, withdraw);
}

// All that wait, also those of the start before.
void Router::refuseWaiting(SenderRecord& sender, Outcome outcome, std::string_view why) {
    while (sender.waiting != nullptr) {
        OutsideEntry& entry = sender.takeFirst();
        if (outcome == Outcome::Expired) ++runtime_.thread(0).rejected;
        entry.settle({outcome, Reason::None, EventText{why}}, runtime_.thread(0).clock);
        publish(entry);
    }
}

}  // namespace cortex
