// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/explorer/view.hpp"

#include "motion/shown_number.hpp"

#include <QString>
#include <optional>
#include <string>
#include <vector>

namespace cortex::explorer {

// One axis of a controller: what its types state, and how it is now. Numbers are in rad or m.
struct MotionAxis {
    QString name;  // "A4", "x"
    std::string axis, demand, device;
    std::string positionUnit, velocityUnit;  // UCUM
    QString demandType;
    std::optional<double> min, max;  // of the position
    std::optional<double> most;      // speed; none: the type of the demand states none

    std::optional<double> position, velocity, wished;
    bool live = false, demandLive = false;
    std::optional<State> drive;  // none: there is no device, or it is not heard

    bool isLinear() const { return positionUnit == "m"; }
    // Whether the demand stands at this end of its range: 1 the upper one, −1 the lower one.
    bool isAtLimit(int direction) const;
    QString limitText() const;                   // "at its upper limit"; empty: it is at none
    bool isSame(const MotionAxis& other) const;  // but for how it is now
};

// The axes of a controller: what it names under `axes` and `demands`, in order.
std::vector<MotionAxis> axesOf(const SystemNow& now, const std::string& controller);
void refresh(MotionAxis& axis, const SystemNow& now);
// Names that are shared become as much of the ends of the paths as tells them apart: "left/1".
void tellApart(std::vector<MotionAxis>& axes);

}  // namespace cortex::explorer
