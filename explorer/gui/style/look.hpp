// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "style/tokens.hpp"

#include <QFont>
#include <QPalette>

class QWidget;

// How everything looks at present: theme, size, fonts. One for the program; GUI thread.
namespace cortex::gui {

// Sizes of text in points at 100 %.
enum class TextSize { Note, Text, Value, Title, Empty };  // 9, 10, 12, 15, 20

class Look {
public:
    // Sets theme and scale (1, 1.25, 1.5) for all windows, those that are open, too. `family`:
    // instead of the font of the desktop; for pictures, which must be alike on every machine.
    static void apply(Theme theme, double scale, const QString& family = {});

    static Theme theme();
    static double scale();
    static const Tokens& colours();
    static QFont font(TextSize size = TextSize::Text, bool strong = false);
    // Pixels of so many units; a unit is 4 pixels at 100 %. All sizes and distances are units.
    static int units(double count);
    static double length(double units);  // the same, not rounded; for drawings
    static int lineWidth();              // 1 px; 2 in high contrast
    // The window of the widget, or that behind its popover, is lower than 700 px at 100 %: rows of
    // data come before words.
    static bool isLow(const QWidget& widget);
};

// Digits of equal width and letters that cannot be taken for digits; otherwise Open Sans, or what
// comes next to it.
QString readableFamily(const QString& wanted);

}  // namespace cortex::gui
