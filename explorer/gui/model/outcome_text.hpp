// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/session.hpp"

#include <QString>

namespace cortex::gui {

// What became of a command, what that means, what to do, and when it came: "Done  1.9 ms, 2 cycles
// 12:04:07.123", "Rejected (range): …", "No answer. The command may have been executed. …".
QString outcomeText(const CommandOutcome& outcome, const Command* command = nullptr);

// The long command that runs, or ran last, of a type that is an Activity.
struct ActivityNow {
    QString command, requester;
    double progress = 0;  // 0 to 1
    bool runs = false;
};
std::optional<ActivityNow> activityOf(const AgentFrame& agent, std::uint32_t simplex);

}  // namespace cortex::gui
