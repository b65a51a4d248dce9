// SPDX-License-Identifier: Apache-2.0
// One task of the reference: states, loss of inputs, quality and stamps.
#include "determinism/reference.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <ranges>
#include <utility>

namespace cortex::determinism {

void Reference::fault(int simplex, std::int64_t code, std::string_view text) {
    RefTask& task = *at(simplex).task;
    if (task.faultPending) return;
    task.faultPending = true;
    task.faultCode = code;
    task.text = inEvent(text);
}

void Reference::runTask(int simplex) {
    RefTask& task = *at(simplex).task;
    if ((cycle_ - 1) % task.every != task.phase && !halted_) return;
    const std::int64_t passed = now_ - task.lastRun;
    const Tick tick{cycle_, now_, passed, std::min(passed, 3 * period * task.every), 0};
    task.lastRun = task.now = now_;
    task.qualitySet = false;
    noteSilence(simplex);
    SlotState state{cycle_, now_, noSimplex, Quality::Good};
    try {
        transition(simplex);
        if (passing(task.state)) putSafe(simplex, tick.elapsedSeconds());
        process(simplex, task.state);
        for (const Link* output : task.outputs) {
            if (!resting(task.state) || !at(output->target).demand) continue;
            tellInVain(simplex, *output, "a handler", "; atRest=\"writer\" frees it");
        }
        // Whole or not at all, also where a handler throws: g++ 12 lets the call write it in place.
        const SlotState read = readInputs(simplex, tick.passed);
        state = read;
        if (!task.faultPending) runHooks(simplex, tick);
    } catch (const std::exception& error) {
        fault(simplex, -1, error.what());
        task.dead = true;
    } catch (...) {
        fault(simplex, -1, "a hook threw something that is no std::exception");
        task.dead = true;
    }
    if (task.faultPending) enterFault(simplex);
    finish(simplex, state, tick.elapsed);
}

void Reference::runHooks(int simplex, const Tick& tick) {
    RefTask& task = *at(simplex).task;
    Behaviour& behaviour = *task.behaviour;
    const State state = task.state;
    if (task.dead) return;
    behaviour.loopStart(task.world, tick);
    if (state == State::Standby) behaviour.standby(task.world);
    if (state == State::StartingUp) task.done = behaviour.startingUp(task.world);
    if (state == State::Active && !task.safeByLoss) behaviour.active(task.world, tick);
    if (state == State::ShuttingDown) task.done = behaviour.shuttingDown(task.world);
    if (state == State::Fault) task.done = behaviour.inFault(task.world);
    behaviour.loopEnd(task.world, tick);
    const double timeout = at(simplex).type->transitionTimeout;
    const bool passing = state == State::StartingUp || state == State::ShuttingDown;
    if (passing && task.stateSince < now_) task.stateSince += tick.passed - tick.elapsed;
    if (passing && !task.done && now_ - task.stateSince >= std::llround(timeout * 1e9)) {
        const std::string hook =
            state == State::StartingUp ? "stateStartingUp" : "stateShuttingDown";
        fault(simplex, -6, hook + " was not done within " + inText(timeout) + " s");
    }
}

void Reference::transition(int simplex) {
    RefTask& task = *at(simplex).task;
    for (Link* output : task.outputs) {
        if (output->refused == nullptr) continue;
        const std::string what = output->refused->name + " of " + at(output->target).path;
        output->refused = nullptr;
        if (output->refusedNotFinite)
            fault(simplex, -3, what + " was not a number");
        else
            fault(simplex, -4, what + " was out of range");
    }
    if (halted_ && task.state == State::Active) {
        fault(simplex, -5, "the loop overran its period and overflow is \"halt\"");
    }
    if (task.faultPending) return enterFault(simplex);
    for (const LifeCycle command :
         {LifeCycle::Shutdown, LifeCycle::ClearFaults, LifeCycle::Startup}) {
        if (!task.pending[static_cast<std::size_t>(command)]) continue;
        const bool outranked = command != LifeCycle::Startup &&
                               task.pending[static_cast<std::size_t>(LifeCycle::Startup)];
        std::ranges::fill(task.pending, false);
        if (outranked) {
            refuseLifeCycle(simplex, LifeCycle::Startup, "another life-cycle command outranks it");
        }
        if (lifeCycle(simplex, command)) return;
    }
    if (!task.done) return;
    if (task.state == State::StartingUp)
        enter(simplex, State::Active);
    else if (task.state == State::ShuttingDown)
        enter(simplex, State::Standby);
}

// Whether the command leads anywhere from this state; else the refusal is an event.
bool Reference::lifeCycle(int simplex, LifeCycle command) {
    RefTask& task = *at(simplex).task;
    const State state = task.state;
    if (command == LifeCycle::Shutdown) {
        if (state != State::StartingUp && state != State::Active) return false;
        task.text.clear();
        enter(simplex, State::ShuttingDown);
        return true;
    }
    task.text.clear();
    if (command == LifeCycle::Startup && state != State::Standby) {
        task.text = std::string{"startup needs Standby, is "} + name(state);
    } else if (command == LifeCycle::ClearFaults && state != State::Fault) {
        task.text = std::string{"clearFaults needs Fault, is "} + name(state);
    } else if (command == LifeCycle::ClearFaults && !task.dead && !task.done) {
        task.text =
            "the fault is not over; its text, or the description of its type, says what ends it";
    } else if (command == LifeCycle::ClearFaults) {
        enter(simplex, State::Standby);
        return true;
    } else if (mayStart(simplex)) {
        enter(simplex, State::StartingUp);
        return true;
    }
    post(simplex, Severity::Warning, EventKind::Refusal, task.text);
    refuseLifeCycle(simplex, command, task.text);
    tell(simplex, task.text);
    return false;
}

bool Reference::mayStart(int simplex) {
    for (const Link* output : at(simplex).task->outputs) {
        if (output->observed == nullptr || output->observed->state.quality == Quality::Good)
            continue;
        at(simplex).task->text =
            "startup needs a good observation of what " + at(output->target).path + " demands";
        return false;
    }
    return true;
}

void Reference::enter(int simplex, State to) {
    RefTask& task = *at(simplex).task;
    const State from = task.state;
    const bool faults = to == State::Fault;
    if ((from == State::Active || faults) &&
        !leaveLong(simplex, faults ? "its simplex went to Fault: " + task.text
                                   : "its simplex left Active")) {
        if (to != State::Fault) {
            fault(simplex, -1, "the handler of its long command threw while it was cancelled");
        }
        task.dead = true;
    }
    const bool comesToRest = to == State::Standby && from != State::Fault;
    if (from == State::Active || to == State::StartingUp || to == State::Fault || comesToRest) {
        latchSafe(simplex, to == State::StartingUp);
        writeSafe(simplex);
    }
    if (from == State::Fault) {
        task.dead = false;
        item<std::int64_t>(simplex, "faultCode") = 0;
        item<std::string>(simplex, "faultText").clear();
    }
    task.state = to;
    task.done = false;
    task.stateSince = now_;
    task.toldInVain = false;
    item<std::int64_t>(simplex, "state") = static_cast<std::int64_t>(to);
    if (to == State::Fault) return;
    post(simplex, Severity::Info, EventKind::StateChange,
         std::string{name(from)} + " -> " + name(to));
}

void Reference::enterFault(int simplex) {
    RefTask& task = *at(simplex).task;
    task.faultPending = false;
    const bool faultedBefore = task.state == State::Fault;
    if (faultedBefore && task.faultCode != -1) return;
    if (!faultedBefore) enter(simplex, State::Fault);
    item<std::int64_t>(simplex, "faultCode") = task.faultCode;
    item<std::string>(simplex, "faultText") = cut(task.text, 48);
    tell(simplex, task.text);
    post(simplex, Severity::Error, EventKind::Fault,
         "fault " + std::to_string(task.faultCode) + ": " + task.text);
}

// A device that has measured nothing new for longer than two of its runs.
void Reference::noteSilence(int simplex) {
    RefTask& task = *at(simplex).task;
    const std::int64_t measured = at(simplex).live.state.time;
    const std::int64_t length = now_ - measured - 2 * period * task.every;
    if (!at(simplex).type->measures || length <= 0) return;
    const bool goesOn = !task.silences.empty() && task.silences.back().first == measured + period;
    if (!goesOn) task.silences.emplace_back();
    task.silences.back() = {measured + period, length};
}

// What followed from its measurements before that is as much younger.
std::int64_t Reference::ageOf(const SlotState& source, const RefTask& reader) const {
    std::int64_t age = now_ - source.time;
    std::int64_t covered = now_;  // from here on by the later one
    int newest = 2;
    for (const auto& [since, length] : reader.silences | std::views::reverse) {
        if (newest-- == 0) break;
        const std::int64_t end = std::min(since + length, std::max(covered, since));
        if (source.time <= since) age -= end - since;
        covered = since;
    }
    return age;
}

// The worst quality with its first cause, the oldest stamp; what a lost input leads to.
SlotState Reference::readInputs(int simplex, std::int64_t passed) {
    RefTask& task = *at(simplex).task;
    SlotState sum{cycle_, now_, noSimplex, Quality::Good};
    const Link* missed = nullptr;
    for (Link* link : task.inputs) {
        const RefSimplex& target = at(link->target);
        const bool ages = target.task != nullptr || !target.writers.empty();
        int writtenEvery = target.task != nullptr ? target.task->plan->every : 1;
        for (const int writer : target.writers) {
            writtenEvery = std::max(writtenEvery, at(writer).task->plan->every);
        }
        link->maxAge = std::max<std::int64_t>(std::llround(link->rule->maxAge * 1e9),
                                              3 * period * writtenEvery);
        const SlotState& source = link->source->state;
        const auto measures = [this](int each) { return at(each).type->measures; };
        const bool outside =
            measures(link->target) || std::ranges::any_of(target.writers, measures);
        const bool unseen = outside && stoodUntil_ > now_ - passed && stood_ > link->maxAge;
        const bool tooOld = (ages && ageOf(source, task) > link->maxAge) || unseen;
        const bool lost = tooOld || source.quality >= Quality::Bad;
        const bool faults =
            lost && link->rule->onLoss == OnLoss::Fault && task.state == State::Active;
        if (lost != std::exchange(link->lost, lost) || faults) inputLost(simplex, *link);
        SlotState seen = source;
        if (tooOld && seen.quality == Quality::Good) {
            seen.quality = Quality::Stale;
            seen.cause = static_cast<std::uint32_t>(link->target);
        }
        if (link->rule->onLoss == OnLoss::Hold && !lost) *link->seen = *link->source;
        if (link->rule->onLoss == OnLoss::Hold && lost) {
            SlotState& held = link->seen->state;
            if (held.quality == Quality::Good) {
                held.quality = Quality::Stale;
                held.cause = seen.cause;
            }
            seen = held;
        }
        if (missed == nullptr && lost && link->rule->onLoss == OnLoss::Safe) missed = link;
        if (seen.quality > sum.quality) {
            sum.quality = seen.quality;
            sum.cause = seen.cause;
        }
        if (ages && seen.time < sum.time) {
            sum.time = seen.time;
            sum.cycle = seen.cycle;
        }
    }
    const bool safe = missed != nullptr && !resting(task.state);
    if (!safe || std::exchange(task.safeByLoss, true)) {
        task.safeByLoss = safe;
        return sum;
    }
    latchSafe(simplex);
    writeSafe(simplex);
    task.lostText = inEvent("its input " + missed->rule->name + " from " + at(missed->target).path +
                            " is lost");
    const Command* runs = at(simplex).longCommand.command;
    if (runs != nullptr && runs->onInputLost == OnInputLost::Fail)
        cancelLong(simplex, task.lostText, true, Outcome::Failed);
    return sum;
}

void Reference::inputLost(int simplex, Link& link) {
    const SlotState& source = link.source->state;
    std::string text = "input " + link.rule->name + " from " + at(link.target).path;
    if (!link.lost) return post(simplex, Severity::Info, EventKind::Loss, text + " is back");
    if (source.quality >= Quality::Bad) {
        text += std::string{" is "} + name(source.quality);
        if (source.cause != noSimplex) text += ", first cause " + all_[source.cause].path;
    } else {
        const std::int64_t age = ageOf(source, *at(simplex).task);
        const bool old = age > link.maxAge;
        const auto time = static_cast<double>(old ? age : stood_);
        const std::string number = inText(std::ceil(time / 1e5) / 10) + " ms";
        text += old ? " is " + number + " old"
                    : " was not followed for " + number + ", as the loop stood still";
        text += ", allowed " + inText(static_cast<double>(link.maxAge) * 1e-6) + " ms";
    }
    if (link.rule->onLoss == OnLoss::Fault && at(simplex).task->state == State::Active) {
        return fault(simplex, -2, text);
    }
    post(simplex, Severity::Warning, EventKind::Loss,
         text + "; reaction: " + name(link.rule->onLoss));
}

void Reference::finish(int simplex, SlotState state, std::int64_t elapsed) {
    RefTask& task = *at(simplex).task;
    const double seconds = static_cast<double>(elapsed) * 1e-9;
    settleSafe(simplex, seconds);
    limitOutputs(simplex, seconds);
    const auto own = static_cast<std::uint32_t>(simplex);
    const Quality least = task.state == State::Fault    ? Quality::Bad
                          : task.state == State::Active ? Quality::Good
                                                        : Quality::Stale;
    if (at(simplex).type->measures && !task.dead) {
        state = {cycle_, now_, noSimplex, Quality::Good};
    } else if (state.quality < least) {
        state.quality = least;
        state.cause = own;
    }
    if (task.qualitySet) {
        state.quality = task.quality;
        state.time = task.measuredAt;
        state.cause = task.quality == Quality::Good ? noSimplex : own;
    }
    at(simplex).live.state = state;
    for (Link* output : task.outputs) {
        const SlotState safe{cycle_, now_, own, Quality::Stale};
        output->seen->state = output->standsSafe ? safe : state;
    }
    for (Link* output : task.outputs) {
        if (!at(output->target).demand) checkValues(simplex, at(output->target), *output->seen);
    }
    checkValues(simplex, at(simplex), at(simplex).live);
}

}  // namespace cortex::determinism
