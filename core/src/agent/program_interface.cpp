// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/program_interface.hpp"

#include "cortex/core/command_exchange.hpp"
#include "cortex/core/error.hpp"

#include <algorithm>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace cortex {
namespace {

constexpr std::int64_t budget = 10'000'000'000;  // ns until a command that was not read is over

}  // namespace

struct ProgramInterface::Implementation {
    Implementation(const std::string& name, std::uint32_t room)
        : client{makeSender(name)}, capacity{room} {}

    void takeAnswers() {
        while (const OutsideAnswer* answer = pipe->answer()) {
            client.take(*answer, *pipe);
            pipe->popAnswer();
        }
    }

    std::mutex mutex;  // guards all but the loop's end of the pipe
    CommandClient client;
    std::uint32_t capacity;
    std::optional<CommandPipe> pipe;
    std::int64_t budgetCycles = 0;
    bool closed = false;
};

std::string CallResult::text() const {
    std::string text = name(outcome);
    if (reason != Reason::None) text += std::string{" ("} + name(reason) + ")";
    if (!why.empty()) text += ": " + why;
    return text;
}

ProgramInterface::ProgramInterface(const std::string& sender, std::uint32_t capacity)
    : implementation_{std::make_unique<Implementation>(sender, capacity)} {}

ProgramInterface::~ProgramInterface() = default;

std::uint64_t ProgramInterface::post(std::string_view path, std::string_view command,
                                     const Arguments& arguments) {
    Implementation& self = *implementation_;
    const std::lock_guard lock{self.mutex};
    if (!self.pipe) throw Error("no command before the agent is started: call start() first");
    if (self.closed) throw Error("no command to an agent that was stopped");
    self.takeAnswers();
    return self.client.post(*self.pipe, path, command, arguments,
                            self.pipe->validFor(self.budgetCycles));
}

bool ProgramInterface::poll(std::uint64_t sequence, CallResult& result) {
    const std::lock_guard lock{implementation_->mutex};
    if (!implementation_->pipe) return false;
    implementation_->takeAnswers();
    return implementation_->client.poll(sequence, result);
}

CallResult ProgramInterface::call(std::string_view path, std::string_view command,
                                  const Arguments& arguments, std::chrono::milliseconds timeout) {
    const auto end = std::chrono::steady_clock::now() + timeout;
    const std::uint64_t sequence = post(path, command, arguments);
    CallResult result;
    auto pause = std::chrono::microseconds{50};
    while (!poll(sequence, result)) {
        if (std::chrono::steady_clock::now() >= end) {
            const std::lock_guard lock{implementation_->mutex};
            implementation_->client.abandon(sequence);
            result.outcome = Outcome::Unknown;
            result.why = "no answer within " + std::to_string(timeout.count()) + " ms";
            return result;
        }
        std::this_thread::sleep_for(pause);
        pause = std::min(pause * 2, std::chrono::microseconds{1000});
    }
    return result;
}

void ProgramInterface::announce(const AgentAccess& agent) {
    const std::lock_guard lock{implementation_->mutex};
    implementation_->pipe.emplace(agent, implementation_->capacity);
    implementation_->budgetCycles = budget / std::max(agent.period, std::int64_t{1});
}

void ProgramInterface::read(Inbox& inbox) { implementation_->pipe->read(inbox); }

void ProgramInterface::write(std::int64_t, Outbox& outbox) { implementation_->pipe->write(outbox); }

void ProgramInterface::close() {
    const std::lock_guard lock{implementation_->mutex};
    implementation_->closed = true;
    implementation_->takeAnswers();
    implementation_->client.loseAll("the agent stopped before it answered");
}

}  // namespace cortex
