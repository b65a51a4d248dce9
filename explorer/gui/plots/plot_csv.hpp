// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plots/drawn_line.hpp"

#include <iosfwd>

namespace cortex::gui {

// Every cycle of a stretch of time that came, one a row: time, cycle of its agent, and for each
// line its value and quality. Numbers at full precision; what is not good has no value.
// Numbers are in the units of the model, which stand in the header.
void writeCsv(std::ostream& out, const std::vector<DrawnLine>& lines, const Recorder& recorder,
              TimeSpan span);

}  // namespace cortex::gui
