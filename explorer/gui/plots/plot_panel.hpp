// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plots/drawn_line.hpp"

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include <qwt_plot.h>

class QwtPlotGrid;

namespace cortex::gui {

class GapItem;
class LimitItem;
class LineItem;

// The lines of one or two units over a time that all panels have in common.
class PlotPanel : public QwtPlot {
    Q_OBJECT
public:
    explicit PlotPanel(QWidget* parent = nullptr);
    ~PlotPanel() override;

    // Values: what is visible decides, and nothing shrinks while it `grows`.
    void show(std::vector<DrawnLine> lines, TimeSpan span, bool grows);
    void restyle();

    const std::vector<DrawnLine>& lines() const { return lines_; }
    std::vector<Gap> gaps() const { return shownGaps_; }
    double yOf(double value, bool right) const;  // in this widget
    QRect canvasBox() const;                     // the same
    double axisExtent(bool right);               // pixels that the axis needs
    void setAxisExtents(double left, double right);

    void zoomValues(double factor);
    void resetValues();  // automatic again

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    struct Axis {
        double low = 0, high = 1;
        bool fixed = false, known = false;
    };
    void fitAxis(bool right, TimeSpan span, bool grows);
    void describe();
    QString titleOf(bool right) const;
    void keepMargins();

    std::vector<DrawnLine> lines_;
    std::vector<std::unique_ptr<LineItem>> items_;
    std::unique_ptr<GapItem> gapItem_;
    std::unique_ptr<LimitItem> limitItem_, limitTexts_;
    QwtPlotGrid* grid_;
    std::array<Axis, 2> axes_;
    std::vector<Gap> shownGaps_;
    double rightMargin_ = 0;
};

}  // namespace cortex::gui
