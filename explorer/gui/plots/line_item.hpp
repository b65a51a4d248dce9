// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plots/drawn_line.hpp"

#include <qwt_plot_item.h>

namespace cortex::gui {

// Draws one line: where many samples share a column of pixels, their minimum and maximum, on a grid
// that does not move against the samples. Never across a gap.
class LineItem : public QwtPlotItem {
public:
    explicit LineItem(const DrawnLine& line);
    void show(const DrawnLine& line) { line_ = line; }
    const DrawnLine& line() const { return line_; }
    void draw(QPainter* painter, const QwtScaleMap& xMap, const QwtScaleMap& yMap,
              const QRectF& canvas) const override;

private:
    DrawnLine line_;
};

}  // namespace cortex::gui
