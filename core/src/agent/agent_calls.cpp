// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_calls.hpp"

#include "cortex/core/record.hpp"

#include <algorithm>

namespace cortex {
AgentCalls::AgentCalls(AgentRuntime& runtime, const LinkTable& links, std::span<Lane* const> lanes)
    : runtime_{runtime}, links_{links} {
    std::size_t calls = 0, octets = 0;
    for (const Lane* lane : lanes) {
        calls += lane->shape().underWay();
        octets += std::size_t{lane->shape().underWay()} * lane->shape().responseSize;
    }
    calls_.resize(calls);
    responses_.resize(octets);
    Call* call = calls_.data();
    std::byte* response = responses_.data();
    for (Lane* lane : lanes) {
        Port& port = ports_.emplace_back();
        port.lane = lane;
        port.calls = {call, lane->shape().underWay()};
        port.order.resize(lane->shape().underWay());
        for (Call& each : port.calls) {
            each.response = response;
            response += lane->shape().responseSize;
        }
        call += lane->shape().underWay();
    }
}

AgentCalls::Call* AgentCalls::offer(Port& port) {
    Lane& lane = *port.lane;
    if (lane.pending(0) <= static_cast<std::int32_t>(port.count)) return nullptr;
    const auto place = std::ranges::find(port.calls, std::uint64_t{0}, &Call::ticket);
    if (place == port.calls.end()) return nullptr;
    const LaneSlot& slot = lane.waiting(port.count);
    Call& call = *place;
    call.ticket = ++serial_ * calls_.size() + static_cast<std::size_t>(&call - calls_.data());
    call.number = lane.number() + port.count;
    call.command = slot.command;
    call.handle = slot.handle;
    call.sent = {slot.cycles, slot.time};
    call.released = call.settled = false;
    call.size = 0;
    port.order[(port.first + port.count++) % port.order.size()] = &call;
    return &call;
}

bool AgentCalls::next(std::uint32_t interface, AgentCall& call) {
    for (Port& port : ports_) {
        const std::uint32_t receiver = port.lane->shape().receiver;
        if (links_.interfaceOf(receiver) != interface) continue;
        LaneSlot& slot = port.lane->waiting(port.count);
        const Call* offered = offer(port);
        if (offered == nullptr) continue;
        const auto& entry = runtime_.commands(receiver).entries[offered->command];
        call = {offered->ticket, receiver, offered->command, entry.request.size,
                port.lane->requestOf(slot)};
        return true;
    }
    return false;
}

void AgentCalls::expire() {
    for (Port& port : ports_) {
        if (links_.interfaceOf(port.lane->shape().receiver) != LinkTable::none) continue;
        while (Call* call = offer(port)) {
            call->verdict = {Outcome::Expired, Reason::None,
                             "its agent is not heard: it was not sent"};
            call->settled = true;
        }
    }
}

void AgentCalls::answer(const AgentCallAnswer& answer) {
    if (calls_.empty()) return;
    Call& call = calls_[answer.ticket % calls_.size()];
    if (call.ticket != answer.ticket) return;
    call.verdict = {answer.outcome, answer.reason, {}};
    if (!answer.why.view().empty()) call.verdict.why.emplace(answer.why);
    call.size = answer.size;
    if (answer.size > 0) copyRecord(call.response, answer.response, answer.size);
    call.settled = true;
}

void AgentCalls::release() {
    for (Port& port : ports_) {
        for (Call& call : port.calls) {
            if (call.settled && call.released) releaseFinal(port, call);
        }
        while (port.count > 0 && port.order[port.first]->settled) {
            Call& call = *port.order[port.first];
            const bool running = call.verdict.outcome == Outcome::Running;
            // By our type it is not long, or too many run: its slot waits for the end.
            if (running && (!port.lane->hasLong() || port.running == port.lane->shape().running)) {
                call.settled = false;
                break;
            }
            releaseSlot(port, call);
            port.first = (port.first + 1U) % static_cast<std::uint32_t>(port.order.size());
            --port.count;
            call.released = running;
            call.settled = false;
            if (running)
                ++port.running;
            else
                call.ticket = 0;
        }
    }
}

void AgentCalls::releaseSlot(Port& port, Call& call) {
    Lane& lane = *port.lane;
    LaneSlot& slot = lane.front();
    const auto& entry = runtime_.commands(lane.shape().receiver).entries[call.command];
    std::byte* response = lane.responseOf(slot);
    copyRecord(response, entry.emptyResponse.data(), entry.response.size);
    if (call.size > 0) copyRecord(response, call.response, call.size);
    lane.answer(slot, call.verdict, runtime_.thread(0).clock);
    if (lane.startsRefusing(!call.verdict.good())) report(port, call);
    lane.pop();
}

void AgentCalls::releaseFinal(Port& port, Call& call) {
    const ChunkClock& clock = runtime_.thread(0).clock;
    AnswerHead answer{call.number,
                      clock.cycle - call.sent.cycle,
                      std::max(clock.nanoseconds - call.sent.nanoseconds, std::int64_t{0}),
                      call.verdict.outcome,
                      call.verdict.reason,
                      {}};
    if (call.verdict.why) answer.why = *call.verdict.why;
    port.lane->finals().add(answer, call.handle, call.response, call.size, clock.cycle);
    if (!call.verdict.good()) report(port, call);
    call.ticket = 0;
    call.settled = false;
    --port.running;
}

void AgentCalls::report(Port& port, const Call& call) {
    const Lane::Shape& shape = port.lane->shape();
    EventText text{runtime_.commands(shape.receiver).entries[call.command].name};
    text << " to " << runtime_.structure().simplexes[shape.receiver].path << ": "
         << name(call.verdict.outcome);
    if (call.verdict.why) text << ", " << call.verdict.why->view();
    runtime_.post(runtime_.thread(0), Severity::Warning, EventKind::Refusal, shape.sender, text);
}

}  // namespace cortex
