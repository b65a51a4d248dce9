// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <QString>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::gui {

// Why nothing can be sent to the simplex now that needs one of these states; empty: it can be sent.
// "needs Standby", "held by alice since 12:03 (4 min)", "read-only: take control of
// /arm", "robot is not heard".
// Shutdown and cancel need no control, and what its type says only stops something needs none where
// nobody else has it. Without a name it is items that are set. What a command to an agent itself
// needs follows from its arguments.
QString whyNotNow(const Frame& frame, Place place, StateSet available,
                  std::string_view command = {}, const comms::Mirror::Arguments& arguments = {});

// What it says to somebody who controls nothing.
QString whyWithoutControl(const Frame& frame, Place place);

// What to take control of for this path: its first part, or "/" for all of an agent.
std::string scopeOf(const Frame& frame, Place place);

// The first parts of all paths that something can be stopped at, sorted.
std::vector<std::string> scopesOf(const Frame& frame);

QString clockText(std::int64_t utc);  // "12:03 UTC" of UTC ns, in the zone that is shown
// "everything" for "/".
QString scopeText(const std::string& prefix);

}  // namespace cortex::gui
