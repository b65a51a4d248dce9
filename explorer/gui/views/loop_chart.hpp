// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/loop_metrics.hpp"

#include <QColor>
#include <QPainter>
#include <QRectF>

// How the rows of a table of loop metrics are drawn. Each is given the box of its cell.
namespace cortex::gui {

constexpr double wholeDuty = 150;  // %, at the right end of the bar

// The mark of a percentile, or of the greatest, around a point.
void paintLoopMark(QPainter& painter, LoopFigure::Which which, QPointF at, const QColor& ink);
// A bar to the last one, a line at 100 %, and marks. What is beyond the end is an arrow.
void paintDuty(QPainter& painter, const QRectF& box, const LoopFigure& duty, bool live,
               const QColor& ink);
void paintDutyScale(QPainter& painter, const QRectF& box, const QColor& ink);
// Marks of a figure on the axis, with its lines behind them.
void paintTimes(QPainter& painter, const QRectF& box, const LoopFigure& figure, const LogAxis& axis,
                const QColor& ink);
void paintTimeScale(QPainter& painter, const QRectF& box, const LogAxis& axis, const QColor& ink);

}  // namespace cortex::gui
