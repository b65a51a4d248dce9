// SPDX-License-Identifier: Apache-2.0
#include "loop/group_commands.hpp"

#include "cortex/core/path.hpp"

#include "tasks/task_states.hpp"

#include <algorithm>
#include <utility>

namespace cortex::cs {

namespace {

bool resting(State state) { return state == State::Standby || state == State::Fault; }

}  // namespace

GroupCommands::GroupCommands(AgentRuntime& agent, TaskStates& states, std::vector<SimplexCS*> order)
    : agent_{agent}, states_{states}, order_{std::move(order)} {
    faultTexts_.reserve(order_.size());
    for (SimplexCS* each : order_) {
        faultTexts_.push_back(each->data<const std::string_view>("faultText"));
    }
    registerHandler<LifeCycle::Startup>("startup");
    registerHandler<LifeCycle::Shutdown>("shutdown");
    registerHandler<LifeCycle::ClearFaults>("clearFaults");
}

template <LifeCycle command>
void GroupCommands::registerHandler(std::string_view name) {
    const CommandTable& table = agent_.commands(agent_.agentSimplex());
    const auto& entry = table.entries[table.find(name)];
    prefixes_[static_cast<std::size_t>(command)].offset = entry.request.find("prefix")->offset;
    agent_.registerHandler(
        agent_.agentSimplex(), name,
        {this, [](void* self, Call& call) {
             auto& group = *static_cast<GroupCommands*>(self);
             return group.handle(command, call, group.prefixes_[static_cast<std::size_t>(command)]);
         }});
}

Outcome GroupCommands::handle(LifeCycle command, Call& call, Argument<std::string_view> prefix) {
    if (call.cancelling()) {
        if (!stopping_) states_.observe(noSimplex);
        return Outcome::Cancelled;
    }
    if (stopping_) return call.fail("the cluster is stopping");
    if (call.first()) {
        begin(command, call[prefix]);
        if (!prefix_.view().empty() && !anyStandsThere()) {
            EventText text{"no active simplex stands at or below "};
            return call.fail((text << prefix_.view()).view());
        }
    }
    if (step()) return Outcome::Running;
    return anyFailed_ ? call.fail(failures_.view()) : Outcome::Done;
}

void GroupCommands::beginStop() {
    begin(LifeCycle::Shutdown, "/");
    stopping_ = true;
}

void GroupCommands::begin(LifeCycle command, std::string_view prefix) {
    command_ = command;
    prefix_ = EventText{withoutEndSlashes(prefix)};
    failures_ = EventText{};
    at_ = 0;
    posted_ = false;
    again_ = false;
    anyFailed_ = false;
}

bool GroupCommands::step() {
    while (at_ < order_.size()) {
        SimplexCS& simplex = member(at_);
        if (!belongs(simplex) || reached(simplex)) {
            ++at_;
            posted_ = false;
            continue;
        }
        if (!posted_) {
            posted_ = true;
            states_.observe(simplex.index());
            agent_.postLifeCycle(simplex.index(), command_, false);
            return true;
        }
        if (!failed(simplex)) return true;
        addFailure(simplex);
        posted_ = false;
        // What comes after relies on it; a shutdown goes on all the same.
        at_ = command_ == LifeCycle::Startup ? order_.size() : at_ + 1;
    }
    states_.observe(noSimplex);
    if (command_ != LifeCycle::Shutdown || std::exchange(again_, true) || !anyWorks()) return false;
    at_ = 0;
    return step();
}

// Something was left to a manager that then faulted.
bool GroupCommands::anyWorks() const {
    return std::ranges::any_of(order_, [this](const SimplexCS* simplex) {
        return belongs(*simplex) && !resting(simplex->state_);
    });
}

std::size_t GroupCommands::place(std::size_t at) const {
    return command_ == LifeCycle::Shutdown ? order_.size() - 1 - at : at;
}

bool GroupCommands::anyStandsThere() const {
    return std::ranges::any_of(order_, [this](const SimplexCS* simplex) {
        return isAtOrBelow(simplex->path(), prefix_.view());
    });
}

bool GroupCommands::belongs(const SimplexCS& simplex) const {
    const bool below = isAtOrBelow(simplex.path(), prefix_.view());
    if (!below || command_ == LifeCycle::ClearFaults || simplex.manager_ == noSimplex) return below;
    // A manager looks after its own while it works.
    const auto& manager = static_cast<const SimplexCS&>(agent_.simplex(simplex.manager_));
    return command_ == LifeCycle::Shutdown && resting(manager.state_);
}

bool GroupCommands::reached(const SimplexCS& simplex) const {
    switch (command_) {
        case LifeCycle::Startup:
            return simplex.state_ == State::Active;
        case LifeCycle::Shutdown:  // what faults on its way has not followed
            return simplex.state_ == State::Standby || (simplex.state_ == State::Fault && !posted_);
        case LifeCycle::ClearFaults:
            return simplex.state_ != State::Fault;
        case LifeCycle::None:
            break;
    }
    return true;
}

bool GroupCommands::failed(const SimplexCS& simplex) const {
    const bool ran = states_.observedRan();
    switch (command_) {
        case LifeCycle::Startup:
            return simplex.state_ == State::Fault || (ran && simplex.state_ == State::Standby);
        case LifeCycle::ClearFaults:
            return ran && simplex.state_ == State::Fault;
        case LifeCycle::Shutdown:
            return simplex.state_ == State::Fault;
        case LifeCycle::None:
            break;
    }
    return false;
}

void GroupCommands::addFailure(const SimplexCS& simplex) {
    if (anyFailed_) failures_ << "; ";
    anyFailed_ = true;
    // Why it refused or faulted since it was asked, otherwise the state that it is in.
    std::string_view why = states_.observedReason().view();
    if (why.empty() && simplex.state_ == State::Fault) why = faultTexts_[place(at_)].get();
    failures_ << simplex.path()
              << " did not follow: " << (why.empty() ? name(simplex.state_) : why);
}

bool GroupCommands::allResting() const {
    return std::ranges::all_of(order_,
                               [](const SimplexCS* simplex) { return resting(simplex->state_); });
}

}  // namespace cortex::cs
