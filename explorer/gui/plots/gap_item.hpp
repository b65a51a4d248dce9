// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plots/drawn_line.hpp"

#include <QRectF>
#include <QString>

#include <qwt_plot_item.h>

class QPainter;

namespace cortex::gui {

QString gapText(const Gap& gap, bool ofAll);  // "no data 0.70 s", "not good 0.11 s"

// Draws the gaps of the lines of one panel, below the lines: hatched, with their length where it
// has room in the gap.
class GapItem : public QwtPlotItem {
public:
    GapItem() { setZ(5); }
    void show(std::vector<Gap> gaps, std::size_t lines);
    void draw(QPainter* painter, const QwtScaleMap& xMap, const QwtScaleMap& yMap,
              const QRectF& canvas) const override;
    // The lengths that have no room in their gaps, in a row above the canvas, beside what is there.
    void paintAbove(QPainter& painter, const QwtScaleMap& xMap, const QRectF& row,
                    std::vector<QRectF> taken) const;

private:
    void paintTexts(QPainter& painter, const QwtScaleMap& xMap, const QRectF& row, bool inside,
                    std::vector<QRectF> taken) const;

    std::vector<Gap> gaps_;
    std::size_t lines_ = 0;
};

}  // namespace cortex::gui
