// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "style/look.hpp"

#include <QPushButton>
#include <initializer_list>

namespace cortex::gui {

inline constexpr double lowButton = 7;  // units

// In a low window these buttons are lower, so that more rows of data are seen.
inline void lowerWhereLow(std::initializer_list<QPushButton*> buttons) {
    for (QPushButton* each : buttons)
        each->setMaximumHeight(Look::isLow(*each) ? Look::units(lowButton) : QWIDGETSIZE_MAX);
}

}  // namespace cortex::gui
