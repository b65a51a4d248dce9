// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/drives/ds402_state.hpp"
#include "cortex/explorer/view.hpp"

#include <QString>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace cortex::explorer {

using drives::Ds402State;

// A number of an axis as its drive says it, and as the drive is told; in the unit of the model.
struct DriveNumber {
    std::string item, unit;  // "position", "rad" (UCUM)
    std::optional<double> now, wished, min, max;
};

// One axis of a Ds402Processor: what its drive says, what the drive is told, and what the
// processor makes of it.
struct DriveAxis {
    int number = 1;                                     // as commands name it
    std::string observation, setpoint, demand, device;  // paths; empty: none is related
    bool homingNeeded = true;
    bool linked = false;  // its device is a FieldbusDevice

    // Why nothing is known of the drive for certain: "/boom/a is lost". Empty: it is.
    QString trouble;
    bool told = false;  // what stands in the set-point is the present value

    Ds402State state = Ds402State::Unknown;   // the last one, where there is trouble
    Ds402State wanted = Ds402State::Unknown;  // that it is being led to
    std::optional<int> statusWord, controlWord, mode, wishedMode;
    bool homed = false;
    int errorCode = 0;
    QString error;  // "following error"; empty: there is none, or it has no name

    QString lastTransition, transitions, refused;  // in brackets where they are not live
    int quickStopOption = 2, homingMethod = 37;
    std::array<DriveNumber, 3> numbers{};

    bool live() const { return trouble.isEmpty(); }
    bool isSame(const DriveAxis& other) const;  // but for how it is now
};

// The axes of a processor: what it names under `drives`, `setpoints` and `demands`, in order; one
// at least, two at most.
std::vector<DriveAxis> driveAxesOf(const SystemNow& now, const std::string& processor);
void refresh(DriveAxis& axis, const SystemNow& now, const std::string& processor);

}  // namespace cortex::explorer
