// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QRectF>

class QPainter;

namespace cortex::gui {

// A stretch of time without data.
void paintHatch(QPainter& painter, const QRectF& box);

}  // namespace cortex::gui
