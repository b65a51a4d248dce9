// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/event_row.hpp"

#include <QString>
#include <utility>
#include <vector>

namespace cortex::gui {

// What is known of the events of a row, as names and texts: where and who, when and how often, the
// numbers that differ, and of a command its sender, arguments, outcome and latency.
using EventDetails = std::vector<std::pair<QString, QString>>;
EventDetails detailsOf(const EventRow& row);

}  // namespace cortex::gui
