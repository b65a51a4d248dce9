// SPDX-License-Identifier: Apache-2.0
#include "peers/sent_commands.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/record.hpp"

#include "wire/cdr.hpp"
#include "wire/ids.hpp"
#include "wire/named_values.hpp"
#include "wire/presence_extras.hpp"
#include "wire/presence_interval.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace cortex::comms {
namespace {

constexpr std::size_t keptNumbers = 1000;
constexpr std::chrono::milliseconds firstPause{5}, longestPauseOfAny{200};
constexpr std::chrono::milliseconds longestPauseOfOldest{40};
constexpr std::chrono::milliseconds firstPauseOfRunning{200}, longestPauseOfRunning{1000};
// After this time no answer can come any more: the agent has let the command expire, and its answer
// was lost.
constexpr std::chrono::seconds grace{1};

constexpr std::int64_t longestPeriod = 100'000'000'000;  // ns

// An agent that sends fewer than ten presences a second has continued since its newest known cycle.
// This is that time, without the tenth of a second that every command allows for.
std::int64_t unheardOf(const CommandTarget& agent, Moment now) {
    const std::int64_t silence =
        std::min((now - agent.heard).count(), agent.model.presence()->interval);
    return std::clamp(silence - shortestInterval, std::int64_t{0}, longestInterval);
}

// By the agent's own clock, which goes on while its loop stands still. The cycle that runs now has
// begun already, so it does not count.
std::int64_t untilOf(const CommandTarget& agent, std::chrono::nanoseconds budget, Moment now) {
    if (agent.clock == 0) return 0;
    const std::int64_t period =
        std::clamp(agent.model.presence()->period, std::int64_t{0}, longestPeriod);
    return agent.clock + (now - agent.clockHeard).count() + budget.count() + period;
}

std::string tooLarge(std::size_t size, const Command& command) {
    const bool one = command.arguments.size() == 1;
    return "the command takes " + std::to_string(size) + " octets, and at most " +
           std::to_string(maxInOneDatagram) + " can be sent at once; nothing was sent: " +
           (one ? "give '" + command.arguments.front().name + "' its value in the system file"
                : "set fewer items at a time");
}

// What the agent says of a command that it does not execute.
bool refusesToAct(Outcome outcome, Reason reason) {
    if (outcome == Outcome::MailboxFull || outcome == Outcome::Expired) return true;
    return outcome == Outcome::Rejected &&
           (reason == Reason::Authority || reason == Reason::Restarted ||
            reason == Reason::Window || reason == Reason::UnknownCommand);
}

}  // namespace

std::uint64_t SentCommands::send(const CommandTarget& agent, std::string_view path,
                                 std::string_view command,
                                 const CommandClient::Arguments& arguments,
                                 std::chrono::nanoseconds budget, Moment now) {
    const CommandTables& tables = agent.tables;
    const std::string& name = agent.model.agent();
    Target& target = targets_.try_emplace(name, sender_).first->second;
    const std::int64_t period = std::max<std::int64_t>(agent.model.presence()->period, 1);
    const std::int64_t cycles = std::max<std::int64_t>(budget.count() / period, 1);
    const PreparedCommand prepared = target.client.prepare(
        tables, path, command, arguments,
        {agent.cycle + unheardOf(agent, now) / period + cycles, untilOf(agent, budget, now)});
    const OutsideCommand& head = prepared.message;
    const bool sent = prepared.open && !agent.lost;
    numbers_[next_] = {
        name, sent ? head.sequence
                   : target.client.takeBack(prepared, Outcome::Expired,
                                            "agent " + name + " is not heard: it was not sent")};
    if (numbers_.size() > keptNumbers) numbers_.erase(numbers_.begin());
    if (!sent) return next_++;

    Pending pending;
    Command& message = pending.message;
    message.link = linkId(sender_.nameText(), name);
    message.sender = sender_.nameText();
    message.host = sender_.host.data();
    message.senderEpoch = sender_.epoch;
    message.target = name;
    message.targetEpoch = head.targetEpoch;
    message.sequenceNumber = head.sequence;
    message.answeredBelow = head.answeredBelow;
    message.notAfter = head.notAfter;
    if (head.until != 0) message.extras.push_back({validUntil, std::to_string(head.until)});
    if (!onBehalfOf_.empty()) message.extras.push_back({onBehalfOf, onBehalfOf_});
    message.path = path;
    message.command = command;
    message.arguments =
        namedValues(argumentsOf(tables.of(head.simplex), head.command, prepared.request()));
    if (const std::size_t size = encodedSize(message); size > maxInOneDatagram) {
        numbers_.at(next_).sequence =
            target.client.takeBack(prepared, Outcome::Rejected, tooLarge(size, message));
        return next_++;
    }
    pending.next = now;
    pending.end = now + budget + grace;
    target.pending[head.sequence] = std::move(pending);
    return next_++;
}

bool SentCommands::hasRoom(const std::string& agent, std::string_view command) const {
    const auto found = targets_.find(agent);
    return found == targets_.end() || found->second.client.hasRoom(command);
}

bool SentCommands::poll(std::uint64_t number, CallResult& answer,
                        std::chrono::nanoseconds* latency) {
    const auto found = numbers_.find(number);
    if (found == numbers_.end()) return false;
    Target& target = targets_.at(found->second.agent);
    if (!target.client.poll(found->second.sequence, answer)) return false;
    const auto took = target.latencies.find(found->second.sequence);
    if (latency != nullptr) {
        *latency = took != target.latencies.end() ? took->second : std::chrono::nanoseconds{0};
    }
    if (took != target.latencies.end()) target.latencies.erase(took);
    numbers_.erase(found);
    return true;
}

bool SentCommands::running(std::uint64_t number) const {
    const auto found = numbers_.find(number);
    return found != numbers_.end() &&
           targets_.at(found->second.agent).client.running(found->second.sequence);
}

void SentCommands::abandon(std::uint64_t number) {
    const auto found = numbers_.find(number);
    if (found == numbers_.end()) return;
    targets_.at(found->second.agent).client.abandon(found->second.sequence);
    numbers_.erase(found);
}

void SentCommands::take(const Answer& answer) {
    if (answer.sender != sender_.nameText() || answer.senderEpoch != sender_.epoch) return;
    const auto found = targets_.find(answer.agent);
    if (found == targets_.end()) return;
    Target& target = found->second;
    const auto pending = target.pending.find(answer.sequenceNumber);
    if (pending == target.pending.end()) return;  // it was answered before
    const auto outcome = outcomeFromName(answer.outcome);
    const auto reason = reasonFromName(answer.reason);
    auto response = valuesOf(answer.response);
    if (answer.epoch != pending->second.message.targetEpoch || !outcome || !reason || !response ||
        *outcome == Outcome::None) {
        ++refused_;
        return;
    }
    if (pending->second.running && refusesToAct(*outcome, *reason)) {
        target.client.take(answer.sequenceNumber, Outcome::Unknown, Reason::None,
                           "it was running, and how it ended the agent does not say: " + answer.why,
                           0, {});
        target.pending.erase(pending);
        return;
    }
    target.client.take(answer.sequenceNumber, *outcome, *reason, answer.why, answer.latencyCycles,
                       std::move(*response));
    if (*outcome == Outcome::Running) return pending->second.run();
    target.pending.erase(pending);
    target.latencies[answer.sequenceNumber] = std::chrono::nanoseconds{answer.latency};
    if (target.latencies.size() > keptNumbers) target.latencies.erase(target.latencies.begin());
}

void SentCommands::tick(Moment now, const Write& write) {
    for (auto& [name, target] : targets_) tick(target, now, write);
}

void SentCommands::tick(Target& target, Moment now, const Write& write) {
    bool first = true;
    for (auto each = target.pending.begin(); each != target.pending.end();) {
        Pending& pending = each->second;
        if (!pending.running && now >= pending.end) {
            target.client.take(each->first, Outcome::Unknown, Reason::None,
                               "no answer within the time that the command had", 0, {});
            each = target.pending.erase(each);
            continue;
        }
        ++each;
        if (!pending.running && std::exchange(first, false)) pending.becomeOldest();
        if (now < pending.next) continue;
        write(pending.message);
        pending.written = now;
        pending.next = now + pending.pause;
        if (!pending.running) pending.next = std::min(pending.next, pending.end);
        pending.pause = std::min(2 * pending.pause, pending.longestPause());
    }
}

std::chrono::milliseconds SentCommands::Pending::longestPause() const {
    if (running) return longestPauseOfRunning;
    return oldest ? longestPauseOfOldest : longestPauseOfAny;
}

// Its end comes by itself, and may be lost: it is asked for.
void SentCommands::Pending::run() {
    if (std::exchange(running, true)) return;
    pause = firstPauseOfRunning;
    next = written + pause;
}

// All later ones may wait for it: its pauses begin anew and stay short.
void SentCommands::Pending::becomeOldest() {
    if (std::exchange(oldest, true)) return;
    next = std::min(next, written + firstPause);
    pause = firstPause;
}

void SentCommands::lose(const std::string& agent, const std::string& why) {
    const auto found = targets_.find(agent);
    if (found == targets_.end()) return;
    found->second.pending.clear();
    found->second.client.loseAll(why);
}

bool SentCommands::waiting() const {
    return std::ranges::any_of(targets_,
                               [](const auto& each) { return !each.second.pending.empty(); });
}

}  // namespace cortex::comms
