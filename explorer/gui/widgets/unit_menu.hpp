// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/shown_units.hpp"

#include <functional>

class QMenu;

namespace cortex::gui {

// What a view says of its units, and takes.
struct UnitsOfView {
    std::function<ShownUnits()> now;
    std::function<void(const ShownUnits&)> choose;
};

// Fills a menu, each time it opens, with the units in which the view can show angles and lengths.
// The function is asked then; a view without units has one entry, which says so.
void fillUnitMenu(QMenu& menu, std::function<UnitsOfView()> view);

}  // namespace cortex::gui
