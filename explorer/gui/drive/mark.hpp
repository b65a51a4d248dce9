// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QRectF>

class QPainter;
class QPalette;

namespace cortex::explorer {

// Small marks beside a word: each is told apart by its shape, whatever its colour.
enum class MarkShape { Disc, Ring, DashedRing, Triangle, Octagon };

// In the colour of its meaning: a limit, a fault; otherwise in that of texts.
void paintMark(QPainter& painter, const QRectF& box, MarkShape shape, const QPalette& palette);

}  // namespace cortex::explorer
