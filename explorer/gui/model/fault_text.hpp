// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/state_times.hpp"

#include <QString>

namespace cortex::gui {

// What a fault says.
struct FaultText {
    QString text;      // in one line; empty: nothing
    bool cut = false;  // it may go on, and ends in "…"
};

// " −7", as the item `faultCode` is written; empty: it is not known.
QString faultCode(const AgentFrame& agent, std::uint32_t simplex);

// The item `faultText` is short, so the event of the same fault says it where the window has it.
FaultText faultText(const Frame& frame, Place place, const StateTimes& times);

}  // namespace cortex::gui
