// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QJsonObject>

class QWidget;

namespace cortex::gui {

// The size of a window for a layout, and whether it is maximised.
QJsonObject savedSize(const QWidget& window);

// As large as its screen at most: what is at its edges is in sight.
void fitToScreen(QWidget& window);

// Not smaller than the window can be, not larger than its screen; what is not said stays.
void restoreSize(QWidget& window, const QJsonObject& saved);

}  // namespace cortex::gui
