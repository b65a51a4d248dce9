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
        const double rounded = std::abs(value) < 1e-12 ? 0 : value;
        QwtText text{numberText(DataItem{}, rounded), QwtText::PlainText};
        text.setColor(Look::colours().ink2);
        return text;
    }
    void forgetColours() { invalidateCache(); }
};

// The titles of the panel, one for each unit: "position (rad)".
class TitleItem : public QwtPlotItem {
public:
    explicit TitleItem(const std::vector<DrawnLine>& lines) : lines_{lines} { setZ(30); }
    void draw(QPainter* painter, const QwtScaleMap& /*xMap*/, const QwtScaleMap& /*yMap*/,
              const QRectF& canvas) const override;

private:
    QString titleOf(bool right) const;

    const std::vector<DrawnLine>& lines_;
};

QString TitleItem::titleOf(bool right) const {
    AxisTitle title;
    for (const DrawnLine& each : lines_) {
        if (each.line.right == right) title.add(each.line);
    }
    return title.text();
}

void TitleItem::draw(QPainter* painter, const QwtScaleMap& /*xMap*/, const QwtScaleMap& /*yMap*/,
                     const QRectF& canvas) const {
    painter->setFont(Look::font(TextSize::Note, true));
    const QFontMetrics metrics{painter->font()};
    const double side = Look::length(2);
    for (const bool right : {false, true}) {
        const QString text = metrics.elidedText(titleOf(right), Qt::ElideRight,
                                                static_cast<int>(canvas.width() / 2));
        if (text.isEmpty()) continue;
        const QRectF box{
            right ? canvas.right() - side - metrics.horizontalAdvance(text) : canvas.left() + side,
            canvas.top() + side / 2, metrics.horizontalAdvance(text) + 1.0,
            static_cast<double>(metrics.height())};
        QColor back = Look::colours().canvas;
        painter->fillRect(box.adjusted(-side / 4, 0, side / 4, 0), back);
        painter->setPen(Look::colours().ink);
        painter->drawText(box, Qt::AlignLeft | Qt::AlignVCenter, text);
    }
}

}  // namespace

PlotPanel::PlotPanel(QWidget* parent)
    : QwtPlot{parent},
      gapItem_{std::make_unique<GapItem>(GapItem::Part::Hatch)},
      gapTexts_{std::make_unique<GapItem>(GapItem::Part::Text)},
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
    gapTexts_->attach(this);
    (new TitleItem{lines_})->attach(this);
    restyle();
}

PlotPanel::~PlotPanel() {
    items_.clear();
    gapItem_.reset();
    gapTexts_.reset();
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
}

// The visible extent with a margin around it.
void PlotPanel::fitAxis(bool right, TimeSpan span, bool grows) {
    Axis& axis = axes_[right ? 1 : 0];
    Extent extent;
    for (const DrawnLine& each : lines_) {
        if (each.line.right == right) extent.add(each.extent(span));
    }
    if (!axis.fixed && extent.any() && std::isfinite(extent.min) && std::isfinite(extent.max)) {
        double around = (extent.max - extent.min) * margin;
        if (around <= 0) around = std::max(std::abs(extent.max) * margin, 0.01);
        around = std::max({around, leastShown, std::abs(extent.max) * leastShare});
        const double low = extent.min - around, high = extent.max + around;
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
    gapTexts_->show(shownGaps_, lines_.size());
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
    describe();
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
    if (own != rightMargin_) {
        rightMargin_ = own;
        setContentsMargins(0, 0, static_cast<int>(std::ceil(own)), 0);
    }
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
