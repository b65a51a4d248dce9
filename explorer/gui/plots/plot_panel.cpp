// SPDX-License-Identifier: Apache-2.0
#include "plots/plot_panel.hpp"

#include "model/value_text.hpp"
#include "plots/gap_item.hpp"
#include "plots/limit_item.hpp"
#include "plots/line_item.hpp"
#include "plots/time_ticks.hpp"
#include "style/look.hpp"

#include <QPainter>
#include <algorithm>
#include <cmath>
#include <set>

#include <qwt_plot_canvas.h>
#include <qwt_plot_grid.h>
#include <qwt_plot_layout.h>
#include <qwt_scale_div.h>
#include <qwt_scale_draw.h>
#include <qwt_scale_engine.h>
#include <qwt_scale_map.h>
#include <qwt_scale_widget.h>

namespace cortex::gui {

namespace {

constexpr double margin = 0.05;  // of what is shown, above and below
constexpr int mostTicks = 6;
// Half of what an axis shows at least: rounding is no curve.
constexpr double leastShown = 1e-9, leastShare = 1e-6;
constexpr double greatest = 4e307;  // at an end of an axis: its length is a number, too

// Numbers of axes are typeset as all numbers.
class NumberScale : public QwtScaleDraw {
public:
    NumberScale() {
        setTickLength(QwtScaleDiv::MajorTick, 0);
        setTickLength(QwtScaleDiv::MediumTick, 0);
        setTickLength(QwtScaleDiv::MinorTick, 0);
        enableComponent(QwtAbstractScaleDraw::Backbone, false);
        enableComponent(QwtAbstractScaleDraw::Ticks, false);
    }
    QwtText label(double value) const override {
        const QList<double> ticks = scaleDiv().ticks(QwtScaleDiv::MajorTick);
        const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 0;
        const double rounded = std::abs(value) < 1e-12 ? 0 : value;
        QwtText text{tickText(rounded, step), QwtText::PlainText};
        text.setColor(Look::colours().ink2);
        return text;
    }
    void forgetColours() { invalidateCache(); }
};

// The row above the canvas. No text of it can hide a line.
int titleHeight() {
    return QFontMetrics{Look::font(TextSize::Note, true)}.height() + Look::units(0.5);
}

}  // namespace

PlotPanel::PlotPanel(QWidget* parent)
    : QwtPlot{parent},
      gapItem_{std::make_unique<GapItem>()},
      limitItem_{std::make_unique<LimitItem>(LimitItem::Part::Band)},
      limitTexts_{std::make_unique<LimitItem>(LimitItem::Part::Text)},
      grid_{new QwtPlotGrid} {
    enableAxis(xBottom, false);
    auto* canvas = new QwtPlotCanvas;
    canvas->setFrameStyle(QFrame::NoFrame);
    canvas->setPaintAttribute(QwtPlotCanvas::BackingStore, false);
    canvas->setFocusIndicator(QwtPlotCanvas::NoFocusIndicator);
    canvas->setFocusPolicy(Qt::NoFocus);
    canvas->setCursor(Qt::ArrowCursor);
    setCanvas(canvas);
    for (const int axis : {yLeft, yRight}) {
        setAxisScaleDraw(axis, new NumberScale);
        axisWidget(axis)->setMargin(Look::units(1));
        axisWidget(axis)->setSpacing(0);
        axisWidget(axis)->setMinBorderDist(0, 0);
        plotLayout()->setAlignCanvasToScale(axis, true);
    }
    plotLayout()->setCanvasMargin(0);
    plotLayout()->setSpacing(0);
    setFocusPolicy(Qt::NoFocus);
    setMinimumHeight(Look::units(16));
    grid_->attach(this);
    limitItem_->attach(this);
    limitTexts_->attach(this);
    gapItem_->attach(this);
    restyle();
}

PlotPanel::~PlotPanel() {
    items_.clear();
    gapItem_.reset();
    limitItem_.reset();
    limitTexts_.reset();
}

void PlotPanel::restyle() {
    setCanvasBackground(Look::colours().canvas);
    grid_->setPen(Look::colours().grid, 1);
    for (const int axis : {yLeft, yRight}) {
        setAxisFont(axis, Look::font(TextSize::Note));
        static_cast<NumberScale*>(axisScaleDraw(axis))->forgetColours();
    }
    for (const auto& each : items_) each->itemChanged();
    keepMargins();
}

// The visible extent with a margin around it.
void PlotPanel::fitAxis(bool right, TimeSpan span, bool grows) {
    Axis& axis = axes_[right ? 1 : 0];
    Extent extent;
    for (const DrawnLine& each : lines_) {
        if (each.line.right == right) extent.add(each.extent(span));
    }
    if (!axis.fixed && extent.any() && std::isfinite(extent.min) && std::isfinite(extent.max)) {
        double around = (extent.max / 2 - extent.min / 2) * 2 * margin;
        if (around <= 0) around = std::max(std::abs(extent.max) * margin, 0.01);
        around = std::max({around, leastShown, std::abs(extent.max) * leastShare});
        const double low = std::max(extent.min - around, -greatest);
        const double high = std::min(extent.max + around, greatest);
        const bool keep = grows && axis.known;
        axis.low = keep ? std::min(axis.low, extent.min >= axis.low ? axis.low : low) : low;
        axis.high = keep ? std::max(axis.high, extent.max <= axis.high ? axis.high : high) : high;
        axis.known = true;
    }
    QwtLinearScaleEngine engine;
    setAxisScaleDiv(right ? yRight : yLeft, engine.divideScale(axis.low, axis.high, mostTicks, 0));
}

void PlotPanel::show(std::vector<DrawnLine> lines, TimeSpan span, bool grows) {
    lines_ = std::move(lines);
    if (items_.size() != lines_.size()) {
        items_.clear();
        for (const DrawnLine& each : lines_) {
            items_.push_back(std::make_unique<LineItem>(each));
            items_.back()->attach(this);
        }
    }
    std::vector<PlotLine> left;
    bool anyRight = false;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        items_[i]->show(lines_[i]);
        items_[i]->setYAxis(lines_[i].line.right ? yRight : yLeft);
        if (!lines_[i].line.right) left.push_back(lines_[i].line);
        anyRight = anyRight || lines_[i].line.right;
    }
    const double width = std::max(canvas()->width(), 1);
    shownGaps_ = gapsOf(lines_, span, span.length() / width);
    gapItem_->show(shownGaps_, lines_.size());
    limitItem_->show(left);
    limitTexts_->show(std::move(left));
    enableAxis(yRight, anyRight);
    fitAxis(false, span, grows);
    if (anyRight) fitAxis(true, span, grows);
    const double step = tickStep(span.length(), width / Look::length(30));
    QwtScaleDiv div{span.from, span.to};
    div.setTicks(QwtScaleDiv::MajorTick, timeTicks(span, step));
    setAxisScaleDiv(xBottom, div);
    replot();
    update(QRect{0, 0, this->width(), titleHeight()});
    describe();
}

// The titles, one for each unit: "position (rad)". Between them, lengths of gaps.
void PlotPanel::paintEvent(QPaintEvent* event) {
    QwtPlot::paintEvent(event);
    QPainter painter{this};
    painter.setFont(Look::font(TextSize::Note, true));
    painter.setPen(Look::colours().ink);
    const QFontMetrics metrics{painter.font()};
    const QRect canvas = canvasBox();
    const QRect row{canvas.left(), 0, canvas.width(), metrics.height()};
    std::vector<QRectF> taken;
    for (const bool right : {false, true}) {
        const int most = axisEnabled(yRight) ? row.width() / 2 : row.width();
        const QString text = metrics.elidedText(titleOf(right), Qt::ElideRight, most);
        if (text.isEmpty()) continue;
        const auto side = right ? Qt::AlignRight : Qt::AlignLeft;
        taken.emplace_back(metrics.boundingRect(row, side, text));
        painter.drawText(row, static_cast<int>(side | Qt::AlignVCenter) | Qt::TextSingleLine, text);
    }
    QwtScaleMap map = canvasMap(xBottom);
    map.setPaintInterval(map.p1() + canvas.left(), map.p2() + canvas.left());
    gapItem_->paintAbove(painter, map, QRectF{row}.adjusted(0.5, 0.5, -0.5, 0.5), std::move(taken));
}

QString PlotPanel::titleOf(bool right) const {
    AxisTitle title;
    for (const DrawnLine& each : lines_) {
        if (each.line.right == right) title.add(each.line);
    }
    return title.text();
}

void PlotPanel::keepMargins() {
    setContentsMargins(0, titleHeight(), static_cast<int>(std::ceil(rightMargin_)), 0);
}

void PlotPanel::describe() {
    QStringList texts;
    for (const DrawnLine& each : lines_) {
        texts.append(QStringLiteral("%1 %2").arg(each.line.tag).arg(each.line.name()));
    }
    for (const Gap& each : shownGaps_) {
        if (texts.size() > 12) break;
        texts.append(gapText(each, each.tags.size() == lines_.size()));
    }
    const QString text = tr("Plot of %1").arg(texts.join(QStringLiteral(", ")));
    if (text == accessibleName()) return;
    setAccessibleName(text);
    canvas()->setAccessibleName(text);
}

double PlotPanel::yOf(double value, bool right) const {
    return canvas()->y() + transform(right ? yRight : yLeft, value);
}

QRect PlotPanel::canvasBox() const { return canvas()->geometry(); }

double PlotPanel::axisExtent(bool right) {
    const int axis = right ? yRight : yLeft;
    if (!axisEnabled(axis)) return 0;
    axisScaleDraw(axis)->setMinimumExtent(0);
    return axisScaleDraw(axis)->extent(axisFont(axis)) + axisWidget(axis)->margin();
}

void PlotPanel::setAxisExtents(double left, double right) {
    axisScaleDraw(yLeft)->setMinimumExtent(left - axisWidget(yLeft)->margin());
    axisScaleDraw(yRight)->setMinimumExtent(right - axisWidget(yRight)->margin());
    const double own = axisEnabled(yRight) ? 0 : right;
    rightMargin_ = own;
    keepMargins();
    updateLayout();
}

void PlotPanel::zoomValues(double factor) {
    for (Axis& each : axes_) {
        const double middle = (each.low + each.high) / 2, half = (each.high - each.low) / 2;
        each.low = middle - half * factor;
        each.high = middle + half * factor;
        each.fixed = true;
    }
}

void PlotPanel::resetValues() { axes_ = {}; }

}  // namespace cortex::gui
