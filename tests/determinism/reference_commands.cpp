// SPDX-License-Identifier: Apache-2.0
// Commands in the reference: along relationships, handlers, long ones, `set`.
#include "determinism/reference.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace cortex::determinism {

namespace {

bool isGood(const Ending& ending) {
    return ending.outcome == Outcome::Done || ending.outcome == Outcome::Running;
}

// "" or why the value is not valid.
std::string wrong(const DataItem& item, const Value& value) {
    const auto check = [&](auto number, auto lowest, auto highest) -> std::string {
        const bool below = number < lowest;
        if (!below && number <= highest) return {};
        std::string text = item.name + ": ";
        if constexpr (std::is_same_v<decltype(number), double>)
            text += inText(number, below ? lowest : highest);
        else
            text += std::to_string(number);
        text += below ? " is below " : " is above ";
        if constexpr (std::is_same_v<decltype(number), double>)
            return text + inText(below ? lowest : highest);
        else
            return text + std::to_string(below ? lowest : highest);
    };
    if (item.kind == Kind::Float) {
        const auto bound = [](const std::optional<Number>& number, double otherwise) {
            if (!number) return otherwise;
            return std::visit([](auto each) { return static_cast<double>(each); }, *number);
        };
        constexpr double greatest = std::numeric_limits<double>::max();
        return check(std::get<1>(value).front(), bound(item.min, -greatest),
                     bound(item.max, greatest));
    }
    if (item.kind != Kind::Int) return {};
    using Limits = std::numeric_limits<std::int64_t>;
    return check(std::get<0>(value).front(), item.min ? std::get<0>(*item.min) : Limits::min(),
                 item.max ? std::get<0>(*item.max) : Limits::max());
}

}  // namespace

std::string needs(const std::string& what, const StateSet& states, State state) {
    std::string text = what + " needs ";
    bool first = true;
    for (int i = 0; i < stateCount; ++i) {
        const auto each = static_cast<State>(i);
        if (!states.has(each)) continue;
        text += std::string{first ? "" : " or "} + name(each);
        first = false;
    }
    return text + ", is " + name(state);
}

Outcome Reference::send(SenderHandle& handle, double amount, std::int64_t number) {
    Line& line = *handle.line;
    handle.answer.outcome = Outcome::None;
    if (line.posted - line.taken >= line.capacity) {
        handle.answer.outcome = Outcome::MailboxFull;
        ++rejected_;
        if (!std::exchange(handle.full, true)) {
            post(line.link->owner, Severity::Warning, EventKind::Refusal,
                 handle.plan->command + " to " + at(line.link->target).path +
                     ": the mailbox is full, not sent");
        }
        return Outcome::MailboxFull;
    }
    handle.full = false;
    ++handle.answer.sent;
    Arguments arguments;
    const bool isSet = handle.plan->command == "set";
    arguments[isSet ? "gain" : "amount"] = std::vector{amount};
    arguments[isSet ? "choice" : "number"] = std::vector{isSet ? number % 7 : number};
    line.sent.push_back({&handle, ++line.posted, cycle_, ++arrivals_, std::move(arguments)});
    return Outcome::None;
}

void Reference::postLifeCycle(int simplex, LifeCycle command, bool later) {
    RefTask& task = *at(simplex).task;
    (later ? task.pendingLater : task.pending)[static_cast<std::size_t>(command)] = true;
}

// What was sent along delayed relationships until now can be seen from now on.
void Reference::latchLines() {
    for (Line& line : lines_) {
        line.visibleSent = line.sent.size();
        line.visibleAnswers = line.answers.size();
        line.visibleFinals = line.finals.size();
    }
    for (const int simplex : tasks_) {
        RefTask& task = *at(simplex).task;
        for (std::size_t i = 0; i < 4; ++i) {
            if (std::exchange(task.pendingLater[i], false)) task.pending[i] = true;
        }
    }
}

void Reference::takeAnswers(Line& line) {
    const auto take = [&](AnswerOnLine& given) {
        SeenAnswer& answer = given.handle->answer;
        const std::uint64_t sent = answer.sent, answered = answer.answered;
        answer = given.answer;
        answer.sent = sent;
        answer.answered = answered;
        given.handle->why = given.why;
    };
    for (std::size_t n = line.delayed ? line.visibleAnswers : line.answers.size(); n > 0; --n) {
        take(line.answers.front());
        ++line.answers.front().handle->answer.answered;
        ++line.taken;
        line.answers.pop_front();
        line.visibleAnswers -= line.delayed ? 1 : 0;
    }
    for (std::size_t n = line.delayed ? line.visibleFinals : line.finals.size(); n > 0; --n) {
        take(line.finals.front());
        line.finals.pop_front();
        line.visibleFinals -= line.delayed ? 1 : 0;
    }
}

// Step (1) of a task: answers, commands along relationships, from outside, the long command.
void Reference::process(int simplex, State state) {
    RefSimplex& self = at(simplex);
    self.longCommand.startedNow = false;
    for (Line* line : self.sending) takeAnswers(*line);
    const auto waiting = [](const Line* line) {
        return line->delayed ? line->visibleSent > 0 : !line->sent.empty();
    };
    if (merge_ == Merge::Arrival) {
        const auto arrival = [&](const Line* line) {
            return waiting(line) ? line->sent.front().arrival : ~std::uint64_t{0};
        };
        while (std::ranges::any_of(self.receiving, waiting)) {
            executeNext(simplex, state, **std::ranges::min_element(self.receiving, {}, arrival));
        }
    }
    for (Line* line : self.receiving) {
        while (waiting(line)) executeNext(simplex, state, *line);
    }
    drainVisitors(simplex, state);
    if (self.longCommand.command != nullptr && !self.longCommand.startedNow) stepLong(simplex);
}

void Reference::executeNext(int simplex, State state, Line& line) {
    const SentCommand sent = std::move(line.sent.front());
    line.sent.pop_front();
    if (line.delayed) --line.visibleSent;
    const std::string& command = sent.handle->plan->command;
    Ending ending{Outcome::Failed, Reason::None, "its handler threw"};
    double sum = 0;
    const auto answer = [&] {
        line.answers.push_back(
            {sent.handle,
             {ending.outcome, ending.reason, sent.number, 0, 0, cycle_ - sent.cycle, {}, sum},
             ending.why});
        count(ending);
        const bool refusing = !isGood(ending);
        if (std::exchange(line.refusing, refusing) || !refusing) return;
        post(simplex, Severity::Warning, EventKind::Refusal,
             command + " from " + at(line.link->owner).path + ": " + cortex::name(ending.outcome) +
                 (ending.why.empty() ? "" : ", " + ending.why));
    };
    const Caller caller{sent.handle, nullptr, sent.number, sent.cycle};
    try {
        ending = execute(simplex, state, command, sent.arguments, caller, sum);
    } catch (...) {
        answer();
        throw;
    }
    answer();
}

void Reference::count(const Ending& ending) {
    const bool refused = ending.outcome == Outcome::Rejected || ending.outcome == Outcome::Expired;
    ++(refused ? rejected_ : commands_);
}

void Reference::drainVisitors(int simplex, State state) {
    std::vector<Visitor*>& visitors = at(simplex).visitors;
    while (!visitors.empty()) {
        Visitor& visitor = *visitors.front();
        visitors.erase(visitors.begin());
        visitor.queued = false;
        Ending ending{Outcome::Expired, Reason::None, "its time was over before its turn"};
        if (!visitor.withdrawnBy.empty()) {
            ending.why = "withdrawn by a later " + visitor.withdrawnBy + " of its sender";
        } else if (cycle_ <= visitor.cycle + visitor.plan->budget) {
            const Caller caller{nullptr, &visitor, 0, visitor.cycle};
            double sum = 0;
            try {
                ending = execute(simplex, state, visitor.plan->command, visitor.plan->arguments,
                                 caller, sum);
            } catch (...) {
                ending = {Outcome::Failed, Reason::None, "its handler threw"};
                settle(visitor, ending);
                count(ending);
                throw;
            }
        }
        settle(visitor, ending);
        count(ending);
    }
}

Ending Reference::execute(int simplex, State state, const std::string& name,
                          const Arguments& arguments, const Caller& caller, double& sum) {
    RefSimplex& self = at(simplex);
    LongCommand& running = self.longCommand;
    if (name == "set") return set(simplex, state, arguments);
    if (name == "cancel") {
        if (running.command == nullptr) {
            return {Outcome::Rejected, Reason::State, "no long command is running"};
        }
        cancelLong(simplex, "cancelled by a command", true);
        return {};
    }
    const Command& command = *self.type->findCommand(name);
    if (!command.available.has(state)) {
        return {Outcome::Rejected, Reason::State, needs(name, command.available, state)};
    }
    if (self.task != nullptr && self.task->dead) {
        return {Outcome::Rejected, Reason::State,
                "one of its hooks threw: clearFaults comes first"};
    }
    for (const DataItem& parameter : command.request) {
        const auto given = arguments.find(parameter.name);
        const std::string why = given == arguments.end() ? "" : wrong(parameter, given->second);
        if (!why.empty()) return {Outcome::Rejected, Reason::Range, why};
    }
    if (command.isLong) return startLong(simplex, command, arguments, caller, sum);
    Ending ending = call(simplex, name, arguments, sum, true, false);
    if (ending.outcome == Outcome::Running) {
        ending = {Outcome::Failed, Reason::None, "only a long command may go on running"};
    }
    return ending;
}

// The handler; what only the framework may answer counts as Failed.
Ending Reference::call(int simplex, const std::string& name, const Arguments& arguments,
                       double& sum, bool first, bool cancelling) {
    if (simplex == agent_) {
        if (cancelling) return {Outcome::Cancelled, Reason::None, {}};
        return group(name, arguments, first);
    }
    RefTask& task = *at(simplex).task;
    const Reply reply = task.behaviour->command(
        task.world, {name, std::get<1>(arguments.at("amount")).front(),
                     std::get<0>(arguments.at("number")).front(), first, cancelling});
    sum = reply.sum;
    Ending ending{reply.outcome, reply.reason, std::string{reply.why}};
    if (ending.outcome == Outcome::None || ending.outcome >= Outcome::MailboxFull) {
        ending.why = std::string{"its handler returned "} + cortex::name(ending.outcome) +
                     ", which is no answer of a handler: Done, Running, Cancelled, call.fail() "
                     "and call.reject() are";
        ending.outcome = Outcome::Failed;
    }
    return ending;
}

Ending Reference::startLong(int simplex, const Command& command, const Arguments& arguments,
                            const Caller& caller, double& sum) {
    LongCommand& running = at(simplex).longCommand;
    const RefTask* task = at(simplex).task.get();
    if (task != nullptr && task->safeByLoss && command.onInputLost == OnInputLost::Fail)
        return {Outcome::Rejected, Reason::State, task->lostText};
    if (running.command != nullptr) {
        if (command.onBusy == OnBusy::Reject) {
            return {Outcome::Rejected, Reason::Busy, running.command->name + " is running"};
        }
        cancelLong(simplex, "replaced by a newer request", true);
    }
    running.startedNow = true;
    running.caller = caller;
    running.since = now_;
    running.arguments = arguments;
    running.sum = 0;
    item<std::string>(simplex, "activity") = command.name;
    item<std::string>(simplex, "requester") = caller.handle != nullptr
                                                  ? at(caller.handle->line->link->owner).path
                                                  : caller.visitor->plan->sender;
    auto& outcome = item<std::int64_t>(simplex, "outcome");
    outcome = static_cast<std::int64_t>(Outcome::Failed);  // if it throws
    const Ending ending = call(simplex, command.name, arguments, running.sum, true, false);
    if (ending.outcome == Outcome::Running) running.command = &command;
    outcome = static_cast<std::int64_t>(ending.outcome);
    sum = running.sum;
    return ending;
}

void Reference::stepLong(int simplex) {
    LongCommand& running = at(simplex).longCommand;
    const Command& command = *running.command;
    const double seconds = static_cast<double>(now_ - running.since) * 1e-9;
    if (command.timeout > 0 && seconds >= command.timeout) {
        return cancelLong(simplex,
                          command.name + ": not done within " + inText(command.timeout) + " s",
                          true, Outcome::Failed);
    }
    Ending ending{Outcome::Failed, Reason::None, "its handler threw"};
    try {
        ending = call(simplex, command.name, running.arguments, running.sum, false, false);
    } catch (...) {
        endLong(simplex, ending);
        throw;
    }
    if (ending.outcome != Outcome::Running) endLong(simplex, ending);
}

void Reference::cancelLong(int simplex, const std::string& why, bool callHandler, Outcome outcome) {
    LongCommand& running = at(simplex).longCommand;
    const Ending ending{outcome, Reason::None, why};
    try {
        if (callHandler) {
            call(simplex, running.command->name, running.arguments, running.sum, false, true);
        }
    } catch (...) {
        endLong(simplex, ending);
        throw;
    }
    endLong(simplex, ending);
}

void Reference::endLong(int simplex, const Ending& ending) {
    LongCommand& running = at(simplex).longCommand;
    running.command = nullptr;
    item<std::int64_t>(simplex, "outcome") = static_cast<std::int64_t>(ending.outcome);
    const Caller& caller = running.caller;
    if (caller.visitor != nullptr) return settle(*caller.visitor, ending);
    caller.handle->line->finals.push_back({caller.handle,
                                           {ending.outcome,
                                            ending.reason,
                                            caller.number,
                                            0,
                                            0,
                                            cycle_ - caller.cycle,
                                            {},
                                            running.sum},
                                           ending.why});
}

// Leaving Active or going to Fault; false: the handler threw. After a throw no handler is called.
bool Reference::leaveLong(int simplex, const std::string& why) {
    if (at(simplex).longCommand.command == nullptr) return true;
    try {
        cancelLong(simplex, why, !at(simplex).task->dead);
    } catch (...) {
        post(simplex, Severity::Error, EventKind::Fault,
             "the handler of its long command threw while it was cancelled");
        return false;
    }
    return true;
}

// All or nothing.
Ending Reference::set(int simplex, State state, const Arguments& arguments) {
    RefSimplex& self = at(simplex);
    for (const DataItem& item : self.type->data) {
        const auto given = arguments.find(item.name);
        if (item.settable.empty() || given == arguments.end()) continue;
        if (self.task != nullptr && !item.settable.has(state)) {
            return {Outcome::Rejected, Reason::State, needs(item.name, item.settable, state)};
        }
        const std::string why = wrong(item, given->second);
        if (!why.empty()) return {Outcome::Rejected, Reason::Range, why};
    }
    if (arguments.empty()) return {Outcome::Rejected, Reason::Range, "set names no item"};
    if (self.task != nullptr && self.task->dead) {
        return {Outcome::Rejected, Reason::State,
                "one of its hooks threw: clearFaults comes first"};
    }
    for (const auto& [name, value] : arguments) {
        if (name == "gain")
            item<double>(simplex, name) = std::get<1>(value).front();
        else
            item<std::int64_t>(simplex, name) = std::get<0>(value).front();
    }
    return {};
}

}  // namespace cortex::determinism
