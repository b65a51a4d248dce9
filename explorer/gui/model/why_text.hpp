// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/state_times.hpp"

#include <QString>
#include <optional>
#include <string>

namespace cortex::gui {

// Who writes the simplex and how it is, and why its values are safe ones or not good, as far as
// that is known: "Written by /control/hold (Standby). Safe values, as /control/hold is in Standby."
QString whyText(const Frame& frame, Place place);

// The input of another agent that is lost, where that is why the simplex is lost.
std::optional<std::string> lostInput(const Frame& frame, Place place);

// Who else claims the path, whose values are shown and who gets commands, and the faults of the
// others, which nothing else shows; empty: nobody else.
QString claimsText(const Frame& frame, Place place, const StateTimes& times);

}  // namespace cortex::gui
