// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/event_filter.hpp"

#include <QString>
#include <string>

namespace cortex::gui {

// The events that are shown, a line each, as `cortex events --csv` writes them. What did not come
// is a line of the kind "missing".
std::string eventsCsv(const EventFilter& events);

// Empty: it is written; otherwise why not.
QString writeEvents(const EventFilter& events, const QString& file);

}  // namespace cortex::gui
