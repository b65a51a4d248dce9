// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/explorer/view.hpp"

#include <QString>
#include <optional>

namespace cortex::explorer {

// How the numbers of an item are written: in the unit that the user has chosen, with so many digits
// that nothing is lost which the model tells.
struct ShownNumber {
    ShownUnit unit{};
    int decimals = 3;

    double of(double number) const { return number * unit.factor; }
    QString text(double number) const;                 // "−43.0"
    QString text(std::optional<double> number) const;  // "—": none
    QString brief(double number) const;                // "−149", of four digits at most
    QString withUnit(double number) const;             // "−43.0°", "25.0 mm/s"
    QString withSign(double number) const;             // "+18.8 °/s"
    // What a person has entered, in the unit of the model. None: it is no number.
    std::optional<double> entered(const QString& text) const;
};

// With decimals that tell a thousandth of the model's unit: 3 in rad, 2 in degrees, 1 in mm.
ShownNumber shownNumber(const ShownUnit& unit);

}  // namespace cortex::explorer
