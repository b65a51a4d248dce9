// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QStringList>

class QWidget;

namespace cortex::test {

// What cannot be read in a window as it is painted, a sentence each: text that is cut without the
// whole of it in a tooltip, text that lies over other text or outside, that is smaller than 9
// points or has a contrast below 4.5.
QStringList unreadableIn(QWidget& window);

}  // namespace cortex::test
