// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drive/drive_axis.hpp"

#include <functional>

namespace cortex::explorer {

// The long command `home` of a processor, whichever axis it is for.
struct Homing {
    bool runs = false;
    double progress = 0;  // 0 to 1
    QString requester;
    QString outcome;  // how the last one ended; empty: well, or there was none

    // The axis is in the mode Homing, or it is not known yet which one is.
    bool isOf(const DriveAxis& axis, const std::vector<DriveAxis>& all) const;
};

Homing homingOf(const SimplexNow& processor);

// Why an axis cannot be told something now, in words for a label at the button. Empty: it can be.
struct AxisReasons {
    QString all;  // why nothing can be told at all, whatever the state; then the others say it, too
    QString enable, disable, quickStop, resetFault, step, setMode, home;
    QString stepToEnabled;  // of transitions that lead to Operation enabled
};

// `homes`: it is this axis that is being homed. `ask`: why the window cannot send this command at
// all, such as for want of control.
AxisReasons reasonsOf(const DriveAxis& axis, const Homing& homing, bool homes,
                      const std::function<QString(const char* command)>& ask);

}  // namespace cortex::explorer
