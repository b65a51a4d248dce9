// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/command_exchange.hpp"
#include "cortex/core/control_commands.hpp"
#include "cortex/core/record.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <utility>

#include <unistd.h>

namespace cortex {
namespace {

constexpr std::size_t keptResults = 1000;
constexpr const char* tooMany = "too many commands of this sender are on their way";

}  // namespace

std::uint64_t CommandClient::post(CommandPipe& pipe, std::string_view path,
                                  std::string_view command, const Arguments& arguments,
                                  Validity validity) {
    const PreparedCommand prepared = prepare(pipe.tables(), path, command, arguments, validity);
    const bool sent = !prepared.open || pipe.push(prepared.message, prepared.request());
    return sent ? prepared.message.sequence : takeBack(prepared, Outcome::MailboxFull, tooMany);
}

bool CommandClient::hasRoom(std::string_view command) const {
    const std::uint32_t kept = isUrgentCommand(command) ? 0 : keptForUrgent;
    return next_ - answeredBelow() + kept < senderWindow;
}

PreparedCommand CommandClient::prepare(const CommandTables& tables, std::string_view path,
                                       std::string_view command, const Arguments& arguments,
                                       Validity validity) {
    PreparedCommand prepared;
    OutsideCommand& message = prepared.message;
    message = tables.find(path, command);
    prepared.record.resize(message.size / 8U + 1U);
    encodeRecord(tables.of(message.simplex), message.command, arguments,
                 reinterpret_cast<std::byte*>(prepared.record.data()));

    message.sender = sender_;
    message.targetEpoch = tables.structure().epoch;
    message.answeredBelow = answeredBelow();
    message.notAfter = validity.notAfter;
    message.until = validity.until;
    prepared.open = hasRoom(command);
    message.sequence = prepared.open ? next_++ : refuse(Outcome::MailboxFull, tooMany);
    if (prepared.open) unanswered_[message.sequence] = {};
    return prepared;
}

std::uint64_t CommandClient::takeBack(const PreparedCommand& prepared, Outcome outcome,
                                      std::string why) {
    if (!prepared.open) return prepared.message.sequence;
    next_ = prepared.message.sequence;
    unanswered_.erase(next_);
    return refuse(outcome, std::move(why));
}

std::uint64_t CommandClient::refuse(Outcome outcome, std::string why) {
    CallResult result;
    result.outcome = outcome;
    result.why = std::move(why);
    keep(nextTicket_, std::move(result));
    return nextTicket_++;
}

// A long one that runs holds up nothing: Running was its answer, the last one follows by itself.
std::uint64_t CommandClient::answeredBelow() const {
    const auto first =
        std::ranges::find_if(unanswered_, [](const auto& each) { return !each.second.running; });
    return first != unanswered_.end() ? first->first : next_;
}

void CommandClient::take(const OutsideAnswer& answer, const CommandPipe& pipe) {
    std::map<std::string, Value> response;
    if (answer.size > 0) {
        const auto& entry = pipe.table(answer.simplex).entries[answer.command];
        response = decodeRecord(entry.response, answer.response);
    }
    take(answer.sequence, answer.outcome, answer.reason, std::string{answer.why.view()},
         answer.latencyCycles, std::move(response));
}

void CommandClient::take(std::uint64_t sequence, Outcome outcome, Reason reason, std::string why,
                         std::int64_t latencyCycles, std::map<std::string, Value> response) {
    const auto asked = unanswered_.find(sequence);
    if (asked == unanswered_.end()) return;
    asked->second.running = outcome == Outcome::Running;
    if (asked->second.running) return;
    finish(sequence, {outcome, reason, std::move(why), std::move(response), latencyCycles});
}

void CommandClient::finish(std::uint64_t sequence, CallResult result) {
    const bool abandoned = unanswered_[sequence].abandoned;
    unanswered_.erase(sequence);
    if (!abandoned) keep(sequence, std::move(result));
}

void CommandClient::keep(std::uint64_t sequence, CallResult result) {
    results_[sequence] = std::move(result);
    if (results_.size() > keptResults) results_.erase(results_.begin());
}

bool CommandClient::poll(std::uint64_t sequence, CallResult& result) {
    const auto found = results_.find(sequence);
    if (found == results_.end()) return false;
    result = std::move(found->second);
    results_.erase(found);
    return true;
}

bool CommandClient::running(std::uint64_t sequence) const {
    const auto found = unanswered_.find(sequence);
    return found != unanswered_.end() && found->second.running;
}

void CommandClient::abandon(std::uint64_t sequence) {
    const auto found = unanswered_.find(sequence);
    if (found != unanswered_.end()) found->second.abandoned = true;
}

void CommandClient::loseAll(const std::string& why) {
    while (!unanswered_.empty()) {
        CallResult result;
        result.outcome = Outcome::Unknown;
        result.why = why;
        finish(unanswered_.begin()->first, std::move(result));
    }
}

Sender makeSender(std::string_view name) {
    static std::atomic<std::int64_t> last{0};
    using namespace std::chrono;
    const auto now = system_clock::now().time_since_epoch();
    std::int64_t epoch = duration_cast<microseconds>(now).count();
    std::int64_t before = last.load();
    do {
        epoch = std::max(epoch, before + 1);
    } while (!last.compare_exchange_weak(before, epoch));

    Sender sender;
    std::ranges::copy(name.substr(0, sender.name.size() - 1), sender.name.begin());
    ::gethostname(sender.host.data(), sender.host.size() - 1);
    sender.epoch = epoch;
    return sender;
}

}  // namespace cortex
