// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <QString>

namespace cortex::gui {

// "robot ended at 12:05:07 UTC."
QString goneText(const GoneAgent& agent);
// "The input /robot/arm is gone: robot ended at 12:05:07 UTC."; empty: its inputs are there.
QString goneInputText(const Frame& frame, Place place);

}  // namespace cortex::gui
