// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plots/plot_lines.hpp"

#include <optional>
#include <vector>

#include <qwt_plot_item.h>

namespace cortex::gui {

// Draws what lies outside of the limits of the left axis' lines: a band where they all have the
// same limit, otherwise an edge for each.
class LimitItem : public QwtPlotItem {
public:
    enum class Part { Band, Text };  // both below the lines; texts above what is hatched
    explicit LimitItem(Part part);
    void show(std::vector<PlotLine> lines) { lines_ = std::move(lines); }
    void draw(QPainter* painter, const QwtScaleMap& xMap, const QwtScaleMap& yMap,
              const QRectF& canvas) const override;

private:
    Part part_;
    std::vector<PlotLine> lines_;
};

}  // namespace cortex::gui
