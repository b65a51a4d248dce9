// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/event.hpp"

#include <filesystem>
#include <iosfwd>

namespace cortex {

// Sinks for EventLog: one line each as lineOf() makes it, dated by the time of day.
EventLog::Sink printEvents(std::ostream& out);  // `out` must outlive the log

// Appends to `file`; throws Error if it cannot be opened. A failed write is said once on stderr.
EventLog::Sink logEvents(const std::filesystem::path& file);

}  // namespace cortex
