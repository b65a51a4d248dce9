// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QColor>

// What a view needs to look like the window, beyond the palette and the font of its widgets.
namespace cortex::explorer {

// What a colour means, where a palette has no role for it.
enum class Tone {
    Quiet,    // what is less important
    Demand,   // what is wished
    Limit,    // at a limit, or beyond it
    Fault,    // of a simplex
    NotLive,  // stale, bad, lost
    Track,    // of a bar; marks only
};

// Of marks, edges and lines, in the theme that applies now.
QColor markColour(Tone tone);
// Of texts on the background of the window and of its rows.
QColor textColour(Tone tone);

// Pixels of so many units, in which the window measures: a unit is 4 pixels at 100 %.
int units(double count);

}  // namespace cortex::explorer
