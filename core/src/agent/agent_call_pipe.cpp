// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/command_exchange.hpp"
#include "cortex/core/record.hpp"

#include <algorithm>
#include <cstddef>

namespace cortex {
namespace {

// The largest record of a command that the agent's own tasks may send to another agent.
std::uint32_t largestRecord(const CommandTables& tables, std::uint32_t CommandTable::* size) {
    std::uint32_t result = 8;
    const auto& simplexes = tables.structure().simplexes;
    for (std::uint32_t i = 0; i < simplexes.size(); ++i) {
        if (simplexes[i].remote) result = std::max(result, tables.of(i).*size);
    }
    return result;
}

}  // namespace

AgentCallPipe::AgentCallPipe(const AgentAccess& agent)
    : tables_{agent.structure}, calls_{agent.calls}, answers_{2 * agent.calls} {
    const std::size_t request = largestRecord(tables_, &CommandTable::maxRequest);
    const std::size_t response = largestRecord(tables_, &CommandTable::maxResponse);
    requests_.resize(calls_.size() * request);
    responses_.resize(answers_.size() * response);
    for (std::size_t i = 0; i < calls_.size(); ++i) {
        calls_.place(i).request = &requests_[i * request];
    }
    for (std::size_t i = 0; i < answers_.size(); ++i) {
        answers_.place(i).response = &responses_[i * response];
    }
}

const std::string& AgentCallPipe::pathOf(const AgentCall& call) const {
    return tables_.structure().simplexes[call.simplex].path;
}

std::string AgentCallPipe::commandOf(const AgentCall& call) const {
    return std::string{table(call).entries[call.command].name};
}

AgentCallPipe::Values AgentCallPipe::argumentsOf(const AgentCall& call) const {
    return cortex::argumentsOf(table(call), call.command, call.request);
}

// There is room: a command has two answers at most, and its place is used again after the last.
void AgentCallPipe::answer(const AgentCall& call, const CallResult& result) {
    AgentCallAnswer* place = answers_.free();
    if (place == nullptr) return;
    const auto& entry = table(call).entries[call.command];
    auto* response = const_cast<std::byte*>(place->response);
    *place = {call.ticket, result.outcome, result.reason, EventText{result.why}, 0, response};
    if (!result.response.empty()) {
        place->size = entry.response.size;
        std::ranges::copy(entry.emptyResponse, response);
        encodeResponse(entry.response, result.response, response);
    }
    answers_.push();
}

void AgentCallPipe::read(Inbox& inbox) {
    for (std::size_t i = 0; i < answers_.size(); ++i) {
        const AgentCallAnswer* answer = answers_.front();
        if (answer == nullptr) return;
        inbox.answer(*answer);
        answers_.pop();
    }
}

bool AgentCallPipe::write(Outbox& outbox) {
    bool any = false;
    AgentCall call;
    while (AgentCall* place = calls_.free()) {
        if (!outbox.nextCall(call)) break;
        auto* request = const_cast<std::byte*>(place->request);
        std::copy_n(call.request, call.size, request);
        *place = call;
        place->request = request;
        calls_.push();
        any = true;
    }
    return any;
}

}  // namespace cortex
