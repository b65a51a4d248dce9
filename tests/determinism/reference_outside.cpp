// SPDX-License-Identifier: Apache-2.0
// Commands from outside in the reference: their order, life-cycle commands, groups of simplexes.
#include "determinism/reference.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cortex::determinism {

namespace {

LifeCycle lifeCycleOf(const std::string& command) {
    if (command == "startup") return LifeCycle::Startup;
    if (command == "shutdown") return LifeCycle::Shutdown;
    if (command == "clearFaults") return LifeCycle::ClearFaults;
    return LifeCycle::None;
}

bool comesBefore(const Visitor* a, const Visitor* b) {
    return std::pair{a->plan->sender, a->sequence} < std::pair{b->plan->sender, b->sequence};
}

std::string describe(const OutsideCommandPlan& plan) {
    std::string text;
    bool first = true;
    for (const auto& [name, value] : plan.arguments) {
        text += (first ? "" : ", ") + name + "=";
        first = false;
        if (const auto* number = std::get_if<std::vector<double>>(&value)) {
            text += inText(number->front());
        } else if (const auto* integer = std::get_if<std::vector<std::int64_t>>(&value)) {
            text += std::to_string(integer->front());
        } else {
            text += "\"" + std::get<3>(value).front() + "\"";
        }
    }
    return text;
}

// Where all is too long, the arguments give way first, and then what became of it.
std::string eventOf(const OutsideCommandPlan& plan, const std::string& became,
                    const std::string& latency) {
    constexpr std::size_t most = 150, least = 20;
    const std::string head = plan.sender + ": " + plan.command + "(", end = "): " + became;
    const std::size_t others = head.size() + end.size();
    const std::size_t room = std::max(most - std::min(most, others), least);
    std::string arguments = inEvent(describe(plan));
    if (arguments.size() > room) arguments = cut(arguments, room - 3) + "…";
    const std::string text = head + arguments + end;
    return text.size() + latency.size() <= most ? text + latency : inEvent(text);
}

}  // namespace

// By sender, then sequence, however they were handed over.
void Reference::readOutside() {
    for (; nextOutside_ < plan_.script.size(); ++nextOutside_) {
        const OutsideCommandPlan& plan = plan_.script[nextOutside_];
        if (plan.tick > cycle_) break;
        Visitor& visitor = visitors_.emplace_back();
        visitor.plan = &plan;
        visitor.sequence = ++sequences_[plan.sender];
        visitor.cycle = cycle_;
        visitor.simplex = find(plan.path);
        const bool urgent = plan.command == "shutdown" || plan.command == "cancel";
        visitor.waitUntil = cycle_ + (urgent ? 0 : plan.budget / 2);
        waiting_[plan.sender].push_back(&visitor);
    }
    std::vector<Visitor*> arrivals;
    for (auto& [sender, waiting] : waiting_) release(waiting, arrivals);
    std::ranges::sort(arrivals, comesBefore);
    for (Visitor* visitor : arrivals) {
        active_.push_back(visitor);
        if (isLifeCycle(*visitor)) {
            deliverLifeCycle(*visitor);
            continue;
        }
        RefSimplex& target = at(visitor->simplex);
        target.visitors.push_back(visitor);
        std::ranges::sort(target.visitors, comesBefore);
    }
}

// What acts before the tasks waits for earlier commands of its sender in queues. Once it may wait
// no longer, or a later one may not, they are withdrawn.
void Reference::release(std::vector<Visitor*>& waiting, std::vector<Visitor*>& arrivals) {
    std::uint64_t due = 0;
    for (const Visitor* each : waiting) {
        if (cycle_ >= each->waitUntil) due = each->sequence;
    }
    const auto allOf = [&](auto&& function) {
        for (Visitor* each : arrivals) function(*each);
        for (Visitor* each : active_) function(*each);
    };
    while (!waiting.empty()) {
        Visitor& first = *waiting.front();
        bool holdsUp = false;
        allOf([&](Visitor& each) { holdsUp = holdsUp || wouldOvertake(first, each); });
        if (holdsUp && first.sequence > due) break;
        allOf([&](Visitor& each) {
            if (each.withdrawnBy.empty() && wouldOvertake(first, each))
                each.withdrawnBy = first.plan->command;
        });
        first.queued = !isLifeCycle(first);
        arrivals.push_back(&first);
        waiting.erase(waiting.begin());
    }
}

bool Reference::isLifeCycle(const Visitor& visitor) {
    return at(visitor.simplex).task != nullptr &&
           lifeCycleOf(visitor.plan->command) != LifeCycle::None;
}

bool Reference::wouldOvertake(const Visitor& visitor, const Visitor& earlier) {
    const bool atOnce = isLifeCycle(visitor);
    if (!earlier.queued || earlier.plan->sender != visitor.plan->sender) return false;
    if (!atOnce && (visitor.simplex != agent_ || earlier.simplex == agent_)) return false;
    return visitor.simplex == earlier.simplex || visitor.simplex == agent_ ||
           earlier.simplex == agent_;
}

void Reference::settle(Visitor& visitor, Ending ending) {
    visitor.ending = std::move(ending);
    visitor.latency = cycle_ - visitor.cycle;
}

void Reference::deliverLifeCycle(Visitor& visitor) {
    RefSimplex& target = at(visitor.simplex);
    const std::string& command = visitor.plan->command;
    const State state = target.task->state;
    const StateSet available = target.type->findCommand(command)->available;
    if (!available.has(state)) {
        ++rejected_;
        return settle(visitor,
                      {Outcome::Rejected, Reason::State, needs(command, available, state)});
    }
    visitor.watched = lifeCycleOf(command);
    visitor.before = state;
    visitor.deadline = now_ + 1'000'000'000 + std::llround(target.type->transitionTimeout * 1e9);
    postLifeCycle(visitor.simplex, visitor.watched, false);
    settle(visitor, {Outcome::Running, Reason::None, {}});
}

void Reference::refuseLifeCycle(int simplex, LifeCycle command, const std::string& why) {
    for (Visitor* visitor : active_) {
        if (visitor->simplex != simplex || visitor->watched != command) continue;
        visitor->watched = LifeCycle::None;
        settle(*visitor, {Outcome::Rejected, Reason::State, why});
        ++rejected_;
    }
}

// At the end of a cycle: has the simplex come to where it was sent?
void Reference::watch(Visitor& visitor) {
    const RefTask& task = *at(visitor.simplex).task;
    const State wanted = visitor.watched == LifeCycle::Startup ? State::Active : State::Standby;
    const bool pending = std::ranges::any_of(task.pending, [](bool each) { return each; });
    std::optional<Ending> ending;
    if (task.state == wanted) {
        ending = Ending{};
    } else if (task.state == State::Fault && visitor.watched != LifeCycle::ClearFaults) {
        ending = {Outcome::Failed, Reason::None, "it went to Fault"};
    } else if (now_ > visitor.deadline) {
        ending = {Outcome::Failed, Reason::None,
                  std::string{"it took too long, is "} + name(task.state)};
    } else if (task.state != visitor.before) {
        visitor.moved = true;
    } else if (visitor.moved) {
        ending = {Outcome::Failed, Reason::None, std::string{"it is back in "} + name(task.state)};
    } else if (!pending) {
        if (visitor.takenCycle == 0) visitor.takenCycle = cycle_;
        if (cycle_ <= visitor.takenCycle + 1) return;
        ++rejected_;
        ending = {Outcome::Rejected, Reason::State, "it did not follow; its events say why"};
    }
    if (!ending) return;
    visitor.watched = LifeCycle::None;
    settle(visitor, *ending);
}

// Answers of this cycle, in the order in which their commands came.
void Reference::collect() {
    for (Visitor* visitor : active_) {
        if (visitor->watched != LifeCycle::None) watch(*visitor);
        if (!visitor->ending) continue;
        const Ending ending = *std::exchange(visitor->ending, std::nullopt);
        observation_.answers.push_back({cycle_, visitor->plan->sender, visitor->sequence,
                                        ending.outcome, ending.reason, ending.why,
                                        visitor->latency});
        if (ending.outcome == Outcome::Running) continue;
        visitor->over = true;
        const bool done = ending.outcome == Outcome::Done;
        const bool refused =
            ending.outcome == Outcome::Rejected || ending.outcome == Outcome::Expired;
        post(visitor->simplex, done ? Severity::Info : Severity::Warning,
             refused ? EventKind::Refusal : EventKind::Command,
             eventOf(*visitor->plan,
                     inEvent(std::string{name(ending.outcome)} +
                             (ending.reason == Reason::None
                                  ? ""
                                  : std::string{" ("} + name(ending.reason) + ")") +
                             (ending.why.empty() ? "" : ", " + ending.why)),
                     visitor->latency == 0 ? " in the same cycle"
                     : visitor->latency == 1
                         ? " in 1 cycle"
                         : " in " + std::to_string(visitor->latency) + " cycles"));
    }
    std::erase_if(active_, [](const Visitor* visitor) { return visitor->over; });
}

// startup, shutdown and clearFaults sent to the agent: one level after the other.
Ending Reference::group(const std::string& command, const Arguments& arguments, bool first) {
    if (first) {
        group_ = {};
        group_.command = lifeCycleOf(command);
        group_.prefix = std::get<3>(arguments.at("prefix")).front();
        while (group_.prefix.ends_with('/')) group_.prefix.pop_back();
        const bool any = std::ranges::any_of(tasks_, [this](int simplex) {
            const std::string& path = at(simplex).path;
            return path == group_.prefix || path.starts_with(group_.prefix + "/");
        });
        if (!any) {
            return {Outcome::Failed, Reason::None,
                    "no active simplex stands at or below " + group_.prefix};
        }
    }
    if (groupStep()) return {Outcome::Running, Reason::None, {}};
    if (group_.failures.empty()) return {};
    return {Outcome::Failed, Reason::None, groupAnswer()};
}

bool Reference::groupCovers(int simplex) {
    const std::string& path = at(simplex).path;
    return path == group_.prefix || path.starts_with(group_.prefix + "/");
}

bool Reference::groupHas(int simplex) {
    const bool below = groupCovers(simplex);
    const int manager = at(simplex).task->manager;
    if (!below || group_.command == LifeCycle::ClearFaults || manager < 0) return below;
    const State state = at(manager).task->state;
    return group_.command == LifeCycle::Shutdown &&
           (state == State::Standby || state == State::Fault);
}

bool Reference::groupIsThere(int simplex, bool asked) {
    const State state = at(simplex).task->state;
    if (group_.command == LifeCycle::Startup) return state == State::Active;
    if (group_.command == LifeCycle::ClearFaults) return state != State::Fault;
    return state == State::Standby || (state == State::Fault && !asked);
}

bool Reference::groupMisses(int simplex) {
    const RefTask& task = *at(simplex).task;
    const bool ran = task.now > group_.asked.at(simplex);
    if (group_.command == LifeCycle::Startup) {
        return task.state == State::Fault || (ran && task.state == State::Standby);
    }
    return (group_.command == LifeCycle::Shutdown || ran) && task.state == State::Fault;
}

// Who did not start of those that it relies on, also through what is not Active; -1: nobody.
int Reference::groupBlocker(int simplex) {
    const auto place = [this](int each) {
        return std::pair{startLevels_[index(each)], at(each).rank};
    };
    int first = -1;
    for (const int each : before_[index(simplex)]) {
        const bool active = isActive(each);
        if (active && group_.started.contains(each)) continue;
        const int found = active && group_.missing.contains(each) ? each : groupBlocker(each);
        if (found >= 0 && (first < 0 || place(found) < place(first))) first = found;
    }
    return first;
}

void Reference::groupFails(int simplex, const std::string& text) {
    group_.failures[{startLevels_[index(simplex)], at(simplex).rank}] =
        at(simplex).path + " " + inEvent(text);
}

void Reference::groupAsk(int simplex) {
    if (at(simplex).task->state == State::Active) group_.started.insert(simplex);
    if (!groupHas(simplex) || groupIsThere(simplex, false)) return;
    const int blocker = group_.command == LifeCycle::Startup ? groupBlocker(simplex) : -1;
    if (blocker < 0) {
        group_.asked[simplex] = at(simplex).task->now;
        postLifeCycle(simplex, group_.command, false);
        return;
    }
    const State state = at(blocker).task->state;
    std::string text = "waits for " + at(blocker).path + ", which is in " + name(state);
    if (state == State::Fault) text += ": " + item<std::string>(blocker, "faultText");
    groupFails(simplex, text);
    post(simplex, Severity::Warning, EventKind::Refusal, text);
}

void Reference::groupLooks() {
    for (const auto& [simplex, since] : group_.asked) {
        if (!groupMisses(simplex)) continue;
        const State state = at(simplex).task->state;
        std::string why = group_.heard[simplex];
        if (why.empty() && state == State::Fault) why = item<std::string>(simplex, "faultText");
        groupFails(simplex, "did not follow: " + (why.empty() ? std::string{name(state)} : why));
        group_.missing.insert(simplex);
    }
}

// True: somebody is still on the way.
bool Reference::groupStep() {
    for (; group_.level < levels_; ++group_.level, group_.posted = false) {
        if (!std::exchange(group_.posted, true) && groupAsks()) return true;
        for (const auto& [simplex, since] : group_.asked) {
            if (!groupIsThere(simplex, true) && !groupMisses(simplex)) return true;
        }
        groupLooks();
    }
    // What a manager was to shut down before it faulted: once more from the beginning.
    const bool left = std::ranges::any_of(tasks_, [this](int simplex) {
        const State state = at(simplex).task->state;
        return groupHas(simplex) && state != State::Standby && state != State::Fault;
    });
    if (group_.command != LifeCycle::Shutdown || group_.again || !left) return false;
    group_.again = true;
    group_.level = 0;
    return groupStep();
}

// Those of the next level, and in a shutdown of the one before it.
bool Reference::groupAsks() {
    const bool down = group_.command == LifeCycle::Shutdown;
    const int level = down ? levels_ - group_.level : group_.level + 1;
    group_.asked.clear();
    group_.heard.clear();
    for (const int simplex : tasks_) {
        if (startLevels_[index(simplex)] == level) groupAsk(simplex);
    }
    return !group_.asked.empty();
}

std::string Reference::groupAnswer() {
    constexpr std::size_t most = 120;
    std::string text;
    std::size_t more = 0;
    for (const auto& [place, failure] : group_.failures) {
        const std::string one = inEvent((text.empty() ? "" : "; ") + failure);
        if (text.empty() || (more == 0 && text.size() + one.size() <= most))
            text += one.substr(0, most);
        else
            ++more;
    }
    if (more > 0) text += "; and " + std::to_string(more) + " more, as events say";
    return inEvent(text);
}

}  // namespace cortex::determinism
