// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/drives/ds402_state.hpp"

#include <QString>
#include <array>
#include <cstdint>
#include <optional>

// What can be asked for in a state of CiA 402, and why not: the tables of the library, in words.
namespace cortex::explorer {

// Transitions that somebody can ask for, in their order.
inline constexpr std::array askableTransitions{2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 15, 16};

// The name of a state, as the standard has it: "Ready to switch on".
QString nameOfState(drives::Ds402State state);

// What the command `step` is sent for a transition from this state. None: it cannot be asked for.
std::optional<std::int64_t> stepWord(int number, drives::Ds402State from, int quickStopOption);

// "Transition 4, enable operation, to Operation enabled".
QString nameOfTransition(int number);

// Why this state does not allow a transition: "needs Switched on". Empty: it does.
QString whyNoTransition(int number, drives::Ds402State from, int quickStopOption);

bool leadsToEnabled(int number);  // to Operation enabled

// All that can be asked for: "4 enable operation, 6 shutdown, 10 disable voltage".
QString transitionsFrom(drives::Ds402State from, int quickStopOption);

}  // namespace cortex::explorer
