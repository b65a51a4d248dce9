// SPDX-License-Identifier: Apache-2.0
#pragma once

class QKeyEvent;
class QWidget;

namespace cortex::gui {

// Enter presses the button of the window that has the keyboard, and opens a list. Qt leaves that to
// dialogs. Whether it was for one: a key that is held down presses nothing more.
bool pressFocused(const QKeyEvent& event, const QWidget& window);

}  // namespace cortex::gui
