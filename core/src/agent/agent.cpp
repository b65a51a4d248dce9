// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agent.hpp"

#include "cortex/core/clock.hpp"

#include "agent/router.hpp"
#include "commands/command_port.hpp"
#include "commands/lane_block.hpp"

#include <algorithm>

namespace cortex {
namespace {

std::uint8_t bitOf(LifeCycle command) {
    return static_cast<std::uint8_t>(1U << static_cast<unsigned>(command));
}

}  // namespace

void AgentRuntime::beginCycle(const Tick& tick) {
    present_.cycle = tick.cycle;
    present_.over = false;
    present_.nominalTime = tick.nominalTime;
    present_.clock = monotonicNow() - tick.lateness;
    lateness_ = tick.lateness;
    for (LoopThread& thread : threads_) {
        thread.sequence = taskSequence;
        thread.nominalTime = tick.nominalTime;
    }
    threads_[0].sequence = 0;
    threads_[0].clock = {tick.cycle, monotonicNow()};
    tables_->latch();
    if (anyLater_.load(std::memory_order_relaxed)) releaseLifeCycles();
    router_->read(interfaces_);
    processTaskless();
    threads_[0].sequence = taskSequence;
}

void AgentRuntime::endCycle(const Tick& tick, std::int64_t wallClock) {
    threads_[0].sequence = endSequence;
    router_->collect();
    images_->publish(tick.cycle, tick.nominalTime, wallClock);
    router_->write(interfaces_);
    events_->complete(tick.cycle);
    present_.over = true;
}

void AgentRuntime::stop() {
    if (!started_ || stopped_) return;
    stopped_ = true;
    router_->stop();
    router_->write(interfaces_);
    for (CommunicationInterface* interface : interfaces_) interface->close();
    events_->complete(present_.cycle);
    events_->stop();
}

void AgentRuntime::releaseLifeCycles() {
    anyLater_.store(false, std::memory_order_relaxed);
    for (std::uint32_t i = 0; i < simplexes_.size(); ++i) {
        const std::uint8_t bits = callsLater_[i].exchange(0, std::memory_order_relaxed);
        if (bits != 0) calls_[i].fetch_or(bits, std::memory_order_relaxed);
    }
}

void AgentRuntime::processTaskless() {
    const auto process = [&](std::uint32_t simplex) {
        if (!hasCommandWork(calls(simplex))) return;
        try {
            processCommands(simplex, State::Active, threads_[0]);
        } catch (...) {  // no task to put into Fault: the event and the answer must do
            post(threads_[0], Severity::Error, EventKind::Fault, simplex,
                 "a command handler threw");
        }
    };
    for (const std::uint32_t simplex : taskless_) process(simplex);
    for (const std::uint32_t simplex : router_->tasklessReceivers()) process(simplex);
}

void AgentRuntime::processCommands(std::uint32_t simplex, State state, LoopThread& thread,
                                   bool dead) {
    ports_[simplex]->process(state, thread, dead);
}

bool AgentRuntime::cancelActivity(std::uint32_t simplex, LoopThread& thread, bool callHandler,
                                  std::string_view why) {
    return ports_[simplex] == nullptr || ports_[simplex]->cancelActivity(thread, callHandler, why);
}

void AgentRuntime::loseInput(std::uint32_t simplex, LoopThread& thread, const EventText& why) {
    if (ports_[simplex] != nullptr) ports_[simplex]->loseInput(thread, why);
}

void AgentRuntime::regainInput(std::uint32_t simplex) {
    if (ports_[simplex] != nullptr) ports_[simplex]->regainInput();
}

LifeCycle AgentRuntime::takeLifeCycle(std::uint32_t simplex, LoopThread& thread) {
    std::atomic<std::uint8_t>& word = calls_[simplex];
    if (!hasLifeCycle(calls(simplex))) return LifeCycle::None;
    const std::uint8_t bits = word.fetch_and(commandWork, std::memory_order_relaxed);
    for (const LifeCycle command : {LifeCycle::Shutdown, LifeCycle::ClearFaults}) {
        if ((bits & bitOf(command)) == 0) continue;
        if ((bits & bitOf(LifeCycle::Startup)) != 0) {
            refuseLifeCycle(simplex, LifeCycle::Startup, "another life-cycle command outranks it",
                            thread);
        }
        return command;
    }
    return LifeCycle::Startup;
}

void AgentRuntime::postLifeCycle(std::uint32_t simplex, LifeCycle command, bool later) {
    auto& word = later ? callsLater_[simplex] : calls_[simplex];
    word.fetch_or(bitOf(command), std::memory_order_relaxed);
    if (later) anyLater_.store(true, std::memory_order_relaxed);
}

void AgentRuntime::refuseLifeCycle(std::uint32_t simplex, LifeCycle command, const EventText& why,
                                   LoopThread& thread) {
    if (router_ != nullptr) router_->refuseLifeCycle(simplex, command, why, thread);
}

}  // namespace cortex
