// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/clock.hpp"
#include "cortex/core/control_commands.hpp"

#include "agent/router.hpp"
#include "commands/command_port.hpp"

namespace cortex {
namespace {

bool takesText(const RecordLayout& request, std::string_view name) {
    const ItemLayout* item = request.find(name);
    return item != nullptr && item->item->kind == Kind::String && item->item->length == 1;
}

std::string_view textIn(const RecordLayout& request, std::string_view name,
                        const std::byte* record) {
    return reinterpret_cast<const StringCell*>(record + request.find(name)->offset)->view();
}

bool onlyStops(const CommandTable::Entry& entry) {
    return entry.command != nullptr && entry.command->stops;
}

void settle(OutsideEntry& entry, const Verdict& verdict, const ChunkClock& clock) {
    entry.watched = LifeCycle::None;
    entry.settle(verdict, clock);
}

}  // namespace

// What is urgent and the commands about control itself are free; a command with a prefix to the
// agent goes to everything below it. What only stops something is refused where somebody else has
// control, and never because nobody has it.
void Router::authorise(const OutsideEntry& entry, Verdict& verdict) const {
    if (isUrgent(entry.simplex, entry.command) || isControl(entry.simplex, entry.command)) return;
    const CommandTable::Entry& command = runtime_.commands(entry.simplex).entries[entry.command];
    const RecordLayout& request = command.request;
    std::string_view path = structure_.simplexes[entry.simplex].path;
    const bool wide = entry.simplex == runtime_.agentSimplex() && takesText(request, "prefix");
    if (wide) path = textIn(request, "prefix", entry.request);
    if (const Lease* lease = leases_.other(path, wide, entry.sender)) {
        verdict = {Outcome::Rejected, Reason::Authority, lease->refusal()};
    } else if (runtime_.options().controlRequired && !onlyStops(command) &&
               !leases_.covered(path, entry.sender)) {
        verdict = {Outcome::Rejected, Reason::Authority, "control is required: take it first"};
    }
}

template <Outcome (Router::*Method)(Call&)>
void Router::setControlHandler(std::string_view command) {
    const std::uint32_t agent = runtime_.agentSimplex();
    const CommandTable& table = runtime_.commands(agent);
    const std::uint32_t index = table.find(command);
    if (index == CommandTable::none || !takesText(table.entries[index].request, "prefix")) return;
    runtime_.registerHandler(agent, command,
                             {this, [](void* router, Call& call) {
                                  return (static_cast<Router*>(router)->*Method)(call);
                              }});
}

void Router::setControlHandlers() {
    setControlHandler<&Router::takeControl>("takeControl");
    setControlHandler<&Router::renewControl>("renewControl");
    setControlHandler<&Router::releaseControl>("releaseControl");
    const CommandTable& table = runtime_.commands(runtime_.agentSimplex());
    renewal_ = table.find("renewControl");
    const std::uint32_t handOver = table.find("handOverControl");
    if (handOver != CommandTable::none && takesText(table.entries[handOver].request, "to")) {
        setControlHandler<&Router::handOverControl>("handOverControl");
    }
}

bool Router::isRenewal(std::uint32_t simplex, std::uint32_t command) const {
    return simplex == runtime_.agentSimplex() && command == renewal_ &&
           renewal_ != CommandTable::none;
}

bool Router::isControl(std::uint32_t simplex, std::uint32_t command) const {
    return simplex == runtime_.agentSimplex() &&
           isControlCommand(runtime_.commands(simplex).entries[command].name);
}

std::string_view Router::argument(Call& call, std::string_view command,
                                  std::string_view name) const {
    const CommandTable& table = runtime_.commands(runtime_.agentSimplex());
    const RecordLayout& request = table.entries[table.find(command)].request;
    return call[Argument<std::string_view>{request.find(name)->offset}];
}

Outcome Router::takeControl(Call& call) {
    return leases_.take(call, argument(call, "takeControl", "prefix"), cycle());
}

Outcome Router::renewControl(Call& call) {
    return leases_.renew(call, argument(call, "renewControl", "prefix"), cycle());
}

Outcome Router::handOverControl(Call& call) {
    return leases_.handOver(call, argument(call, "handOverControl", "prefix"),
                            argument(call, "handOverControl", "to"), cycle());
}

Outcome Router::releaseControl(Call& call) {
    return leases_.release(call, argument(call, "releaseControl", "prefix"));
}

void Router::senderLost(const Sender& sender) {
    SenderRecord* known = senders_.known(interface_, sender);
    if (known != nullptr) refuseWaiting(*known, Outcome::Expired, "its sender is gone");
    for (const OutsideEntry* entry : active_) {
        if (entry->sender != sender || isLifeCycle(*entry)) continue;
        const Command* command = runtime_.commands(entry->simplex).entries[entry->command].command;
        CommandPort& port = *runtime_.ports_[entry->simplex];
        if (command != nullptr && command->onSenderLost == OnSenderLost::Cancel &&
            port.activityOrigin() == entry) {
            port.requestCancel("its sender was lost");
        }
    }
    Lease lost;
    while (leases_.takeLeaseOf(sender, lost)) controlLost(lost, "it is gone");
}

void Router::controlLost(const Lease& lease, std::string_view how) {
    EventText text = lease.holderText();
    text << " no longer has control of " << lease.prefix.view() << ": " << how;
    event(Severity::Warning, EventKind::Control, runtime_.agentSimplex(), text);
    for (const std::uint32_t simplex : leaseMinded_) {
        const SimplexInfo& info = structure_.simplexes[simplex];
        if (!isAtOrBelow(info.path, lease.prefix.view())) continue;
        if (info.layout->type->onLeaseLost == OnLeaseLost::Shutdown) {
            runtime_.postLifeCycle(simplex, LifeCycle::Shutdown, false);
        } else if (runtime_.ports_[simplex] != nullptr) {
            runtime_.ports_[simplex]->requestCancel("control was lost");
        }
    }
}

void Router::findStates() {
    states_.reserve(structure_.simplexes.size());
    for (std::uint32_t i = 0; i < structure_.simplexes.size(); ++i) {
        const SimplexInfo& info = structure_.simplexes[i];
        const ItemLayout* item = info.layout->find("state");
        const bool task = info.role == Role::Active && !info.remote && i != runtime_.agentSimplex();
        const bool has = task && item != nullptr && item->item->kind == Kind::Int;
        states_.push_back(has ? runtime_.tables().live(i).ints + item->offset : nullptr);
        if (task && info.layout->type->onLeaseLost != OnLeaseLost::Continue) {
            leaseMinded_.push_back(i);
        }
    }
}

bool Router::isLifeCycle(std::uint32_t simplex, std::uint32_t command) const {
    const auto& name = runtime_.commands(simplex).entries[command].name;
    return states_[simplex] != nullptr && lifeCycleCommand(name) != LifeCycle::None;
}

void Router::deliverLifeCycle(OutsideEntry& entry) {
    const auto& command = runtime_.commands(entry.simplex).entries[entry.command];
    const ChunkClock& clock = runtime_.thread(0).clock;
    const State state = stateOf(entry.simplex);
    if (!command.available.has(state)) {
        ++runtime_.thread(0).rejected;
        entry.settle({Outcome::Rejected, Reason::State,
                      stateRefusal(command.name, command.available, state)},
                     clock);
        return;
    }
    const Type& type = *structure_.simplexes[entry.simplex].layout->type;
    entry.watched = lifeCycleCommand(command.name);
    entry.stateBefore = state;
    entry.takenCycle = 0;
    entry.deadline =
        runtime_.nominalTime() + nsPerSecond +
        static_cast<std::int64_t>(type.transitionTimeout * static_cast<double>(nsPerSecond));
    runtime_.postLifeCycle(entry.simplex, entry.watched, false);
    entry.settle({Outcome::Running, Reason::None, {}}, clock);
}

// After the tasks of a cycle: has the simplex come to where it was sent?
void Router::watch(OutsideEntry& entry) {
    const ChunkClock& clock = runtime_.thread(0).clock;
    const State state = stateOf(entry.simplex);
    const State wanted = entry.watched == LifeCycle::Startup ? State::Active : State::Standby;
    if (state == wanted) {
        settle(entry, {}, clock);
    } else if (state == State::Fault && entry.watched != LifeCycle::ClearFaults) {
        settle(entry, {Outcome::Failed, Reason::None, "it went to Fault"}, clock);
    } else if (runtime_.nominalTime() > entry.deadline) {
        settle(entry,
               {Outcome::Failed, Reason::None, EventText{"it took too long, is "} << name(state)},
               clock);
    } else if (state != entry.stateBefore) {
        entry.moved = true;
    } else if (entry.moved) {
        settle(entry, {Outcome::Failed, Reason::None, EventText{"it is back in "} << name(state)},
               clock);
    } else if (!AgentRuntime::hasLifeCycle(runtime_.calls(entry.simplex))) {
        if (entry.takenCycle == 0) entry.takenCycle = cycle();
        if (cycle() <= entry.takenCycle + 1) return;
        ++runtime_.thread(0).rejected;
        settle(entry, {Outcome::Rejected, Reason::State, "it did not follow; its events say why"},
               clock);
    }
}

void Router::refuseLifeCycle(std::uint32_t simplex, LifeCycle command, const EventText& why,
                             LoopThread& thread) {
    for (OutsideEntry* entry : active_) {
        if (entry->simplex != simplex || entry->watched != command) continue;
        settle(*entry, {Outcome::Rejected, Reason::State, why}, began_);
        ++thread.rejected;
    }
}

}  // namespace cortex
