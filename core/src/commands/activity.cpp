// SPDX-License-Identifier: Apache-2.0
#include "commands/activity.hpp"

#include <algorithm>

namespace cortex {
namespace {

template <class T>
Data<T> itemOf(const PortAccess& agent, std::uint32_t simplex, std::string_view item) {
    const ItemLayout* layout = agent.structure.simplexes[simplex].layout->find(item);
    if (layout == nullptr || layout->item->kind != kindFor<T>() || layout->item->constant ||
        layout->item->length != 1) {
        return {};
    }
    void* cell = agent.tables.live(simplex).at(layout->item->kind, layout->offset);
    return Data<T>{static_cast<typename StorageOf<T>::type*>(cell)};
}

}  // namespace

Activity::Activity(const PortAccess& agent, std::uint32_t simplex, const CommandTable& table)
    : agent_{agent},
      request_{std::make_unique<std::uint64_t[]>(table.maxRequest / 8U + 1U)},
      response_{std::make_unique<std::uint64_t[]>(table.maxResponse / 8U + 1U)},
      outcome_{itemOf<std::int64_t>(agent, simplex, "outcome")},
      name_{itemOf<std::string_view>(agent, simplex, "activity")},
      requester_{itemOf<std::string_view>(agent, simplex, "requester")},
      progress_{itemOf<double>(agent, simplex, "progress")} {}

void Activity::start(const CommandTable::Entry& entry, const Handler& handler,
                     const std::byte* request, const Origin& origin, Verdict& verdict) {
    handler_ = handler;
    origin_ = origin;
    startedTime_ = agent_.present.nominalTime;
    copyRecord(reinterpret_cast<std::byte*>(request_.get()), request, entry.request.size);
    copyRecord(reinterpret_cast<std::byte*>(response_.get()), entry.emptyResponse.data(),
               entry.response.size);
    if (name_.bound()) name_ = entry.name;
    if (requester_.bound()) requester_ = requesterName();
    if (progress_.bound()) progress_ = 0.0;  // of the command before
    if (outcome_.bound()) outcome_ = static_cast<std::int64_t>(Outcome::Failed);
    verdict = call(entry, true, false);  // if it throws: Failed, and not running
    if (verdict.outcome == Outcome::Running) entry_ = &entry;
    if (outcome_.bound()) outcome_ = static_cast<std::int64_t>(verdict.outcome);
}

void Activity::step(const ChunkClock& clock) {
    const double seconds = static_cast<double>(agent_.present.nominalTime - startedTime_) * 1e-9;
    const double timeout = entry_->command->timeout;
    if (timeout > 0 && seconds >= timeout) {
        EventText why{entry_->name};
        stop(clock, true,
             {Outcome::Failed, Reason::None, why << ": not done within " << timeout << " s"});
        return;
    }
    Verdict verdict{Outcome::Failed, Reason::None, "its handler threw"};
    try {
        verdict = call(*entry_, false, false);
    } catch (...) {
        finish(verdict, clock);
        throw;
    }
    if (verdict.outcome != Outcome::Running) finish(verdict, clock);
}

void Activity::cancel(const ChunkClock& clock, bool callHandler, std::string_view why) {
    stop(clock, callHandler, {Outcome::Cancelled, Reason::None, why});
}

void Activity::loseInput(const ChunkClock& clock, const EventText& why) {
    inputLost_ = why;
    if (running() && !mayRun(*entry_)) stop(clock, true, {Outcome::Failed, Reason::None, why});
}

void Activity::stop(const ChunkClock& clock, bool callHandler, const Verdict& verdict) {
    try {
        if (callHandler) call(*entry_, false, true);
    } catch (...) {
        finish(verdict, clock);
        throw;
    }
    finish(verdict, clock);
}

Verdict Activity::call(const CommandTable::Entry& entry, bool first, bool cancelling) {
    auto* response = reinterpret_cast<std::byte*>(response_.get());
    Call call{reinterpret_cast<const std::byte*>(request_.get()), response};
    call.setTime(agent_.present.nominalTime, startedTime_);
    call.setFirst(first);
    call.setCancelling(cancelling);
    if (origin_.outside != nullptr) origin_.outside->tellOrigin(call);
    const Outcome outcome = handler_(call);
    return outcome == Outcome::Done ? doneVerdict(entry, response) : verdictOf(outcome, call);
}

void Activity::finish(const Verdict& verdict, const ChunkClock& clock) {
    const std::uint32_t size = entry_->response.size;
    entry_ = nullptr;
    if (outcome_.bound()) outcome_ = static_cast<std::int64_t>(verdict.outcome);
    if (origin_.lane != nullptr) {
        AnswerHead answer{origin_.number,
                          clock.cycle - origin_.sentCycle,
                          std::max(clock.nanoseconds - origin_.sentTime, std::int64_t{0}),
                          verdict.outcome,
                          verdict.reason,
                          {}};
        if (verdict.why) answer.why = *verdict.why;
        origin_.lane->finals().add(answer, origin_.handle, response(), size, clock.cycle);
    } else {
        copyRecord(origin_.outside->response, response(), size);
        origin_.outside->settle(verdict, clock);
    }
}

std::string_view Activity::requesterName() const {
    if (origin_.outside != nullptr) return origin_.outside->sender.nameText();
    return agent_.structure.simplexes[origin_.lane->shape().sender].path;
}

}  // namespace cortex
