// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QStringList>
#include <functional>
#include <string>

class QWidget;

namespace cortex::test {

// What cannot be read in a window as it is painted, a sentence each: text that is cut without the
// whole of it in a tooltip, or that is never to be cut; text that lies over other text or outside,
// that is smaller than 9 points or has a contrast below 4.5.
QStringList unreadableIn(QWidget& window);
// The same in three sizes of window and text and in both fonts; `refresh` shows what there is now.
std::string unreadableInEverySize(QWidget& window, const std::function<void()>& refresh);

}  // namespace cortex::test
