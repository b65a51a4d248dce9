// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/command.hpp"
#include "cortex/core/state.hpp"

#include <array>
#include <optional>

namespace cortex::cs {

constexpr bool isResting(State state) { return state == State::Standby || state == State::Fault; }
constexpr bool isPassing(State state) {
    return state == State::StartingUp || state == State::ShuttingDown;
}

// What can move the state machine of an active simplex. Faults lead from every state to Fault.
enum class Move : std::uint8_t { Startup, Shutdown, ClearFaults, Done };

struct Transition {
    State from;
    Move move;
    State to;
};

inline constexpr std::array transitions{
    Transition{State::Standby, Move::Startup, State::StartingUp},
    Transition{State::StartingUp, Move::Done, State::Active},
    Transition{State::StartingUp, Move::Shutdown, State::ShuttingDown},
    Transition{State::Active, Move::Shutdown, State::ShuttingDown},
    Transition{State::ShuttingDown, Move::Done, State::Standby},
    Transition{State::Fault, Move::ClearFaults, State::Standby},
};

constexpr std::optional<State> next(State from, Move move) {
    for (const Transition& transition : transitions) {
        if (transition.from == from && transition.move == move) return transition.to;
    }
    return std::nullopt;
}

constexpr Move moveOf(LifeCycle command) {
    switch (command) {
        case LifeCycle::Startup:
            return Move::Startup;
        case LifeCycle::ClearFaults:
            return Move::ClearFaults;
        case LifeCycle::Shutdown:
        case LifeCycle::None:
            break;
    }
    return Move::Shutdown;
}

}  // namespace cortex::cs
