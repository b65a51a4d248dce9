// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <QString>

namespace cortex::explorer {

// Why nothing can be sent to the simplex now that needs one of these states; empty: it can be sent.
// "needs Standby", "held by cortex@desk.4711-3f since 12:03 (4 min)", "read-only: take control of
// /arm", "robot is not heard".
QString whyNotNow(const Frame& frame, Place place, StateSet available);

// What to take control of for this path: its first part, or "/" for all of an agent.
std::string scopeOf(const Frame& frame, Place place);

QString clockText(std::int64_t utc);  // "12:03" of UTC ns
// "everything" for "/".
QString scopeText(const std::string& prefix);

}  // namespace cortex::explorer
