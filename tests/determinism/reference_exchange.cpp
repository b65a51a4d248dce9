// SPDX-License-Identifier: Apache-2.0
// How a task of the reference hands demands over from one of its choices to another.
#include "determinism/reference.hpp"

#include <algorithm>
#include <cstddef>

namespace cortex::determinism {

namespace {

// The numbers that handOver() answers.
constexpr int othersStart = 0, othersStop = 1, allDone = 2, oneFailed = 3;

State stateOf(const Choice& choice) { return static_cast<State>(*choice.state); }

}  // namespace

void Reference::addChoice(int simplex, std::size_t planned) {
    const Link& link = linkOf(simplex, planned);
    at(link.target).task->manager = simplex;
    const std::size_t place = at(link.target).shape->find("state")->first;
    at(simplex).task->choices.push_back(
        {.target = link.target, .later = link.delayed, .state = &link.seen->ints[place]});
}

// Asks to start, at first and every 500 cycles' time. Whether the choice has not followed.
bool Reference::refuses(Choice& choice) {
    if (stateOf(choice) != State::Standby) return false;
    const bool asked = choice.askedAt >= 0;
    const std::int64_t cycles = at(choice.target).task->every + (choice.later ? 1 : 0);
    const bool refused = asked && cycle_ >= choice.askedIn + cycles;
    if (!asked || now_ >= choice.askedAt + 500 * period) {
        postLifeCycle(choice.target, LifeCycle::Startup, choice.later);
        choice.askedAt = now_;
        choice.askedIn = cycle_;
    }
    return refused;
}

// By one that nobody wants any more, but that writes a simplex of it and became Active later.
bool Reference::isReplaced(const Choice& choice, const std::vector<Choice>& choices,
                           std::uint64_t wanted) const {
    for (std::size_t i = 0; i < choices.size(); ++i) {
        if ((wanted >> i & 1U) != 0 || choices[i].activeSince <= choice.activeSince) continue;
        for (const RefSimplex& each : all_) {
            const auto writes = [&each](int simplex) {
                return std::ranges::find(each.writers, simplex) != each.writers.end();
            };
            if (writes(choice.target) && writes(choices[i].target)) return true;
        }
    }
    return false;
}

int Reference::handOver(int simplex, std::uint64_t wanted) {
    std::vector<Choice>& choices = at(simplex).task->choices;
    const auto isWanted = [&](const Choice& choice) {
        return (wanted >> (&choice - choices.data()) & 1U) != 0;
    };
    const auto stop = [this](const Choice& choice) {
        postLifeCycle(choice.target, LifeCycle::Shutdown, choice.later);
    };
    bool fails = false, othersActive = false, othersRest = true, allActive = true;
    for (Choice& choice : choices) {
        const State state = stateOf(choice);
        if (state != State::Standby || !isWanted(choice)) choice.askedAt = -1;
        if (state != State::Active) choice.activeSince = -1;
        if (state == State::Active && choice.activeSince < 0) choice.activeSince = cycle_;
        if (isWanted(choice)) {
            fails = fails || state == State::Fault;
        } else {
            othersActive = othersActive || state == State::Active;
            othersRest = othersRest && resting(state);
            if (state == State::StartingUp) stop(choice);
        }
    }
    for (Choice& choice : choices) {
        if (!isWanted(choice)) continue;
        const bool active = stateOf(choice) == State::Active;
        const bool replaced = active && isReplaced(choice, choices, wanted);
        if (replaced) stop(choice);
        allActive = allActive && active && !replaced;
        if (!fails) fails = refuses(choice);
    }
    for (const Choice& choice : choices) {
        const State state = stateOf(choice);
        if (state != State::StartingUp && state != State::Active) continue;
        if (isWanted(choice) ? fails && othersActive : allActive) stop(choice);
    }
    if (fails) return oneFailed;
    if (!allActive) return othersStart;
    return othersRest ? allDone : othersStop;
}

}  // namespace cortex::determinism
