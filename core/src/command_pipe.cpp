// SPDX-License-Identifier: Apache-2.0
#include "command_pipe.hpp"

#include "cortex/core/error.hpp"

#include "lookup.hpp"
#include "record.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <utility>

#include <unistd.h>

namespace cortex {
namespace {

constexpr std::size_t keptResults = 1000;

std::uint32_t indexOf(const CommandTable& table, std::string_view path, std::string_view command) {
    const std::uint32_t index = table.find(command);
    if (index != CommandTable::none) return index;
    std::vector<std::string> valid;
    for (const auto& entry : table.entries) valid.emplace_back(entry.name);
    throwUnknown(std::string{path} + " has no command '" + std::string{command} + "'", command,
                 valid);
}

}  // namespace

CommandPipe::CommandPipe(const AgentAccess& agent, std::uint32_t capacity)
    : agent_{agent}, commands_{capacity}, answers_{2 * capacity} {
    std::size_t request = 8, response = 8;
    for (const SimplexInfo& info : structure().simplexes) {
        auto [place, added] = byLayout_.try_emplace(info.layout);
        if (added) place->second = commandTable(*info.layout->type);
        tables_.push_back(&place->second);
        request = std::max<std::size_t>(request, place->second.maxRequest);
        response = std::max<std::size_t>(response, place->second.maxResponse);
    }
    requests_.resize(commands_.size() * request);
    responses_.resize(answers_.size() * response);
    for (std::size_t i = 0; i < commands_.size(); ++i) {
        commands_.place(i).request = &requests_[i * request];
    }
    for (std::size_t i = 0; i < answers_.size(); ++i) {
        answers_.place(i).response = &responses_[i * response];
    }
}

bool CommandPipe::push(const OutsideCommand& command, const std::byte* record) {
    OutsideCommand* place = commands_.free();
    if (place == nullptr) return false;
    // The buffers are ours; the messages show them as const.
    auto* request = const_cast<std::byte*>(place->request);
    *place = command;
    place->request = request;
    std::copy_n(record, command.size, request);
    commands_.push();
    return true;
}

void CommandPipe::read(Inbox& inbox) {
    for (std::size_t i = 0; i < commands_.size(); ++i) {
        const OutsideCommand* command = commands_.front();
        if (command == nullptr) return;
        inbox.command(*command);
        commands_.pop();
    }
}

void CommandPipe::write(Outbox& outbox) {
    OutsideAnswer answer;
    while (OutsideAnswer* place = answers_.free()) {
        if (!outbox.nextAnswer(answer)) return;
        auto* response = const_cast<std::byte*>(place->response);
        std::copy_n(answer.response, answer.size, response);
        *place = answer;
        place->response = response;
        answers_.push();
    }
}

std::uint64_t CommandClient::post(CommandPipe& pipe, std::string_view path,
                                  std::string_view command,
                                  const ProgramInterface::Arguments& arguments,
                                  std::int64_t notAfter) {
    OutsideCommand message;
    message.simplex = simplexAt(pipe.structure(), path);
    const CommandTable& table = pipe.table(message.simplex);
    message.command = indexOf(table, path, command);
    message.size = table.entries[message.command].request.size;
    std::vector<std::uint64_t> record(message.size / 8U + 1U);
    auto* octets = reinterpret_cast<std::byte*>(record.data());
    encodeRecord(table, message.command, arguments, octets);

    message.sender = sender_;
    message.targetEpoch = pipe.structure().epoch;
    message.answeredBelow = answeredBelow();
    message.sequence = next_++;
    message.notAfter = notAfter;
    unanswered_[message.sequence] = {};
    const bool windowFull = message.sequence - message.answeredBelow >= senderWindow;
    if (windowFull || !pipe.push(message, octets)) {
        CallResult result;
        result.outcome = Outcome::MailboxFull;
        result.why = "too many commands of this sender are on their way";
        finish(message.sequence, std::move(result));
    }
    return message.sequence;
}

// A long one that runs holds up nothing: Running was its answer, the last one follows by itself.
std::uint64_t CommandClient::answeredBelow() const {
    const auto first =
        std::ranges::find_if(unanswered_, [](const auto& each) { return !each.second.running; });
    return first != unanswered_.end() ? first->first : next_;
}

void CommandClient::take(const OutsideAnswer& answer, const CommandPipe& pipe) {
    const auto asked = unanswered_.find(answer.sequence);
    if (asked == unanswered_.end()) return;
    asked->second.running = answer.outcome == Outcome::Running;
    if (asked->second.running) return;
    CallResult result;
    result.outcome = answer.outcome;
    result.reason = answer.reason;
    result.why = answer.why.view();
    result.latencyCycles = answer.latencyCycles;
    if (answer.size > 0) {
        const auto& entry = pipe.table(answer.simplex).entries[answer.command];
        result.response = decodeRecord(entry.response, answer.response);
    }
    finish(answer.sequence, std::move(result));
}

void CommandClient::finish(std::uint64_t sequence, CallResult result) {
    const bool abandoned = unanswered_[sequence].abandoned;
    unanswered_.erase(sequence);
    if (abandoned) return;
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
