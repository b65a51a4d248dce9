// SPDX-License-Identifier: Apache-2.0
#include "loop/group_commands.hpp"

#include "cortex/core/path.hpp"

#include "tasks/state_machine.hpp"

#include <algorithm>
#include <utility>

namespace cortex::cs {

namespace {

constexpr std::size_t mostOfAnswer = 120;  // characters; behind them, how many more there are

}  // namespace

GroupCommands::GroupCommands(AgentRuntime& agent, TaskStates& states, StartOrder order)
    : agent_{agent},
      states_{states},
      order_{std::move(order)},
      members_(order_.nodes.size()),
      blockers_(order_.nodes.size(), noSimplex) {
    for (std::uint32_t node = 0; node < order_.nodes.size(); ++node) {
        SimplexCS* each = order_.nodes[node].active;
        if (each == nullptr) continue;
        actives_.push_back(node);
        members_[node] = std::make_unique<Member>();
        members_[node]->faultText = each->data<const std::string_view>("faultText");
        states_.registerWatched(each->index(), members_[node]->watched);
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
        if (!stopping_) states_.watch(false);
        return Outcome::Cancelled;
    }
    if (stopping_) return call.fail("the cluster is stopping");
    if (call.first()) {
        begin(command, call[prefix]);
        if (!prefix_.view().empty() && !anyStandsThere()) {
            states_.watch(false);
            EventText text{"no active simplex stands at or below "};
            return call.fail((text << prefix_.view()).view());
        }
    }
    if (step()) return Outcome::Running;
    return anyFailed_ ? call.fail(answer().view()) : Outcome::Done;
}

void GroupCommands::beginStop() {
    begin(LifeCycle::Shutdown, "/");
    stopping_ = true;
}

void GroupCommands::begin(LifeCycle command, std::string_view prefix) {
    command_ = command;
    prefix_ = EventText{withoutEndSlashes(prefix)};
    level_ = 0;
    asked_ = false;
    again_ = false;
    anyFailed_ = false;
    std::ranges::fill(blockers_, noSimplex);
    for (const std::uint32_t node : actives_) {
        members_[node]->watched = {};
        members_[node]->failed = false;
    }
    states_.watch(true);
}

bool GroupCommands::step() {
    for (; level_ < order_.levels.size(); ++level_, asked_ = false) {
        if (!std::exchange(asked_, true) && ask()) return true;
        if (goesOn()) return true;
        settle();
    }
    if (command_ == LifeCycle::Shutdown && !std::exchange(again_, true) && anyWorks()) {
        level_ = 0;
        return step();
    }
    states_.watch(false);
    return false;
}

const StartOrder::Level& GroupCommands::level() const {
    const bool reverse = command_ == LifeCycle::Shutdown;
    return order_.levels[reverse ? order_.levels.size() - 1 - level_ : level_];
}

// All of a level at once. False: nobody had to be asked.
bool GroupCommands::ask() {
    bool any = false;
    for (std::uint32_t node = level().first; node < level().passive; ++node) {
        const SimplexCS& each = simplex(node);
        TaskStates::Watched& watched = members_[node]->watched;
        watched.asked = false;
        if (each.state_ != State::Active) blockers_[node] = blockerOf(node);
        if (!belongs(each) || reached(node)) continue;
        if (command_ == LifeCycle::Startup && blockers_[node] != noSimplex) {
            holdBack(node);
            continue;
        }
        any = true;
        watched = {.asked = true, .ran = false, .reason = {}};
        agent_.postLifeCycle(each.index(), command_, false);
    }
    return any;
}

bool GroupCommands::goesOn() const {
    for (std::uint32_t node = level().first; node < level().passive; ++node) {
        if (members_[node]->watched.asked && !reached(node) && !failed(node)) return true;
    }
    return false;
}

void GroupCommands::settle() {
    for (std::uint32_t node = level().first; node < level().passive; ++node) {
        const Member& member = *members_[node];
        if (!member.watched.asked || !failed(node)) continue;
        // Why it refused or faulted since it was asked, otherwise the state that it is in.
        const State state = simplex(node).state_;
        std::string_view why = member.watched.reason.view();
        if (why.empty() && state == State::Fault) why = member.faultText.get();
        EventText text{"did not follow: "};
        text << (why.empty() ? name(state) : why);
        fail(node, text);
        blockers_[node] = node;
    }
    for (std::uint32_t node = level().passive; node < level().end; ++node) {
        blockers_[node] = blockerOf(node);
    }
}

void GroupCommands::holdBack(std::uint32_t node) {
    const std::uint32_t blocker = blockers_[node];
    const SimplexCS& other = simplex(blocker);
    EventText text{"waits for "};
    text << other.path() << ", which is in " << name(other.state_);
    if (other.state_ == State::Fault) text << ": " << members_[blocker]->faultText.get();
    fail(node, text);
    tell(Severity::Warning, node);
}

void GroupCommands::fail(std::uint32_t node, const EventText& text) {
    members_[node]->failed = true;
    members_[node]->failure = text;
    members_[node]->watched = {};
    anyFailed_ = true;
}

void GroupCommands::tell(Severity severity, std::uint32_t node) {
    agent_.post(agent_.thread(0), severity, EventKind::Refusal, simplex(node).index(),
                members_[node]->failure);
}

// As many as an answer has room for. Each has an event of its own.
EventText GroupCommands::answer() const {
    EventText text;
    std::size_t more = 0;
    for (const std::uint32_t node : actives_) {
        if (!members_[node]->failed) continue;
        EventText one{text.view().empty() ? "" : "; "};
        one << simplex(node).path() << " " << members_[node]->failure.view();
        const bool first = text.view().empty();
        const bool fits = more == 0 && text.view().size() + one.view().size() <= mostOfAnswer;
        if (first || fits)
            text << one.view().substr(0, mostOfAnswer);
        else
            ++more;
    }
    if (more > 0) text << "; and " << more << " more, as events say";
    return text;
}

std::vector<std::string> GroupCommands::notFollowed() const {
    std::vector<std::string> lines;
    for (const std::uint32_t node : actives_) {
        if (!members_[node]->failed) continue;
        lines.push_back(simplex(node).path() + " " + std::string{members_[node]->failure.view()});
    }
    return lines;
}

void GroupCommands::tellOverdue(double seconds) {
    const auto stuck = std::ranges::find_if(actives_, [this](std::uint32_t node) {
        return members_[node]->watched.asked && !isResting(simplex(node).state_);
    });
    for (const std::uint32_t node : actives_) {
        const SimplexCS& each = simplex(node);
        if (isResting(each.state_)) continue;
        EventText text{"did not follow: "};
        if (members_[node]->watched.asked || stuck == actives_.end()) {
            text << name(each.state_);
        } else {
            text << "waits for " << simplex(*stuck).path() << ", which is in "
                 << name(simplex(*stuck).state_);
        }
        text << " after the stopTimeout of " << seconds << " s; now in Standby by force";
        fail(node, text);
        tell(Severity::Error, node);
    }
    states_.watch(false);
}

// Something was left to a manager that then faulted.
bool GroupCommands::anyWorks() const {
    return std::ranges::any_of(actives_, [this](std::uint32_t node) {
        return belongs(simplex(node)) && !isResting(simplex(node).state_);
    });
}

bool GroupCommands::anyStandsThere() const {
    return std::ranges::any_of(actives_, [this](std::uint32_t node) {
        return isAtOrBelow(simplex(node).path(), prefix_.view());
    });
}

bool GroupCommands::belongs(const SimplexCS& simplex) const {
    const bool below = isAtOrBelow(simplex.path(), prefix_.view());
    if (!below || command_ == LifeCycle::ClearFaults || simplex.manager_ == noSimplex) return below;
    // A manager looks after its own while it works.
    const auto& manager = static_cast<const SimplexCS&>(agent_.simplex(simplex.manager_));
    return command_ == LifeCycle::Shutdown && isResting(manager.state_);
}

bool GroupCommands::reached(std::uint32_t node) const {
    const State state = simplex(node).state_;
    switch (command_) {
        case LifeCycle::Startup:
            return state == State::Active;
        case LifeCycle::Shutdown:
            return state == State::Standby ||
                   (state == State::Fault && !members_[node]->watched.asked);
        case LifeCycle::ClearFaults:
            return state != State::Fault;
        case LifeCycle::None:
            break;
    }
    return true;
}

bool GroupCommands::failed(std::uint32_t node) const {
    const State state = simplex(node).state_;
    const bool ran = members_[node]->watched.ran;
    switch (command_) {
        case LifeCycle::Startup:
            return state == State::Fault || (ran && state == State::Standby);
        case LifeCycle::ClearFaults:
            return ran && state == State::Fault;
        case LifeCycle::Shutdown:
            return state == State::Fault;
        case LifeCycle::None:
            break;
    }
    return false;
}

// Whoever failed among those that it relies on, directly or through others; the first of them.
std::uint32_t GroupCommands::blockerOf(std::uint32_t node) const {
    std::uint32_t first = noSimplex;
    for (const std::uint32_t before : order_.nodes[node].before) {
        first = std::min(first, blockers_[before]);
    }
    return first;
}

bool GroupCommands::allResting() const {
    return std::ranges::all_of(
        actives_, [this](std::uint32_t node) { return isResting(simplex(node).state_); });
}

}  // namespace cortex::cs
