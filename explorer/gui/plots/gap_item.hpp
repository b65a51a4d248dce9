// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plots/drawn_line.hpp"

#include <QRectF>
#include <QString>

#include <qwt_plot_item.h>

class QPainter;

namespace cortex::gui {

QString gapText(const Gap& gap, bool ofAll);  // "no data 0.70 s"

// Draws the gaps of the lines of one panel: hatched, with their length where there is room.
class GapItem : public QwtPlotItem {
public:
    enum class Part { Hatch, Text };  // below the lines, and above them
    explicit GapItem(Part part);
    void show(std::vector<Gap> gaps, std::size_t lines);
    void draw(QPainter* painter, const QwtScaleMap& xMap, const QwtScaleMap& yMap,
              const QRectF& canvas) const override;

private:
    static void paintText(QPainter& painter, const QString& text, const QRectF& box,
                          const QRectF& canvas, std::vector<QRectF>& chips);

    Part part_;
    std::vector<Gap> gaps_;
    std::size_t lines_ = 0;
};

}  // namespace cortex::gui
