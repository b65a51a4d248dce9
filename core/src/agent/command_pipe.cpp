// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/clock.hpp"
#include "cortex/core/command_exchange.hpp"

#include "tables/lookup.hpp"

#include <algorithm>

namespace cortex {

CommandTables::CommandTables(std::shared_ptr<const Structure> structure)
    : structure_{std::move(structure)} {
    for (const SimplexInfo& info : structure_->simplexes) {
        auto [place, added] = byLayout_.try_emplace(info.layout);
        if (added) place->second = commandTable(*info.layout->type);
        tables_.push_back(&place->second);
    }
}

OutsideCommand CommandTables::find(std::string_view path, std::string_view command) const {
    OutsideCommand found;
    found.simplex = simplexAt(*structure_, path);
    const CommandTable& table = of(found.simplex);
    found.command = table.find(command);
    if (found.command == CommandTable::none) {
        std::vector<std::string> valid;
        for (const auto& entry : table.entries) valid.emplace_back(entry.name);
        throwUnknown(std::string{path} + " has no command '" + std::string{command} + "'", command,
                     valid);
    }
    found.size = table.entries[found.command].request.size;
    return found;
}

CommandPipe::CommandPipe(const AgentAccess& agent, std::uint32_t capacity)
    : agent_{agent}, tables_{agent.structure}, commands_{capacity}, answers_{2 * capacity} {
    std::size_t request = 8, response = 8;
    for (std::uint32_t i = 0; i < structure().simplexes.size(); ++i) {
        request = std::max<std::size_t>(request, table(i).maxRequest);
        response = std::max<std::size_t>(response, table(i).maxResponse);
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

// The cycle that runs now has begun already, so it does not count.
Validity CommandPipe::validFor(std::int64_t cycles) const {
    return {agent_.newestCycle() + cycles,
            agent_.realTime ? monotonicNow() + (cycles + 1) * agent_.period : 0};
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

bool CommandPipe::skip(const OutsideCommand& command) {
    OutsideCommand number;
    number.sender = command.sender;
    number.targetEpoch = command.targetEpoch;
    number.sequence = command.sequence;
    number.answeredBelow = command.answeredBelow;
    number.refused = true;
    return push(number, nullptr);
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

}  // namespace cortex
