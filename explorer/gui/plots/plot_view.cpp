// SPDX-License-Identifier: Apache-2.0
#include "plots/plot_view.hpp"

#include "model/plain_text.hpp"
#include "plots/lane_strip.hpp"
#include "plots/overview_strip.hpp"
#include "plots/plot_bar.hpp"
#include "plots/plot_legend.hpp"
#include "plots/plot_panel.hpp"
#include "plots/plot_pointer.hpp"
#include "plots/tag_strip.hpp"
#include "plots/time_axis.hpp"
#include "plots/time_ticks.hpp"
#include "style/look.hpp"
#include "widgets/drop_zone.hpp"
#include "widgets/focus_edge.hpp"
#include "widgets/text_label.hpp"

#include <QEvent>
#include <QHBoxLayout>
#include <QPainter>
#include <QScrollArea>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <utility>

namespace cortex::gui {

namespace {

constexpr double silence = 0.3;  // s behind the others, after which a line is missed
constexpr int legendEvery = 3;   // frames: digits that change faster cannot be read

// With room for a scroll bar.
int sideWidth(const PlotLegend& legend) { return legend.sizeHint().width() + Look::units(3); }

}  // namespace

PlotView::PlotView(Recorder& recorder, QWidget* parent)
    : QWidget{parent},
      recorder_{recorder},
      bar_{new PlotBar},
      empty_{new TextLabel{TextSize::Empty}},
      hint_{new TextLabel{TextSize::Text, false, &Tokens::ink2}},
      foot_{new TextLabel{TextSize::Note, false, &Tokens::ink2}},
      body_{new QWidget},
      column_{new QWidget},
      stack_{new QVBoxLayout},
      lanes_{new LaneStrip},
      axis_{new TimeAxis},
      overview_{new OverviewStrip},
      legend_{new PlotLegend},
      overlay_{new CursorOverlay{column_}},
      zone_{new DropZone{this}},
      pointer_{new PlotPointer{*this}} {
    setAccessibleName(tr("Plot"));
    setFocusPolicy(Qt::StrongFocus);
    setProperty(wantsFocusEdge, true);
    setAcceptDrops(true);
    build();
    connect(bar_, &PlotBar::followWanted, this, [this] {
        range_.follow();
        redraw();
    });
    connect(bar_, &PlotBar::holdWanted, this, [this] {
        range_.hold();
        redraw();
    });
    connect(bar_, &PlotBar::spanWanted, this, [this](double seconds) {
        range_.setSpan(seconds);
        redraw();
    });
    connect(bar_, &PlotBar::cursorsWanted, this, &PlotView::toggleCursors);
    connect(bar_, &PlotBar::statisticsWanted, this, &PlotView::toggleStatistics);
    connect(bar_, &PlotBar::legendWanted, this, [this] { showLegend(side_->isHidden()); });
    connect(bar_, &PlotBar::exportWanted, this, &PlotView::askForFile);
    connect(overview_, &OverviewStrip::moved, this, [this](double to) {
        range_.show({to - range_.span(), to});
        redraw();
    });
    connect(legend_, &PlotLegend::menuWanted, this, &PlotView::openMenu);
    silence_.start();
    redraw();
}

PlotView::~PlotView() { recorder_.record(this, {}); }

void PlotView::build() {
    auto* rows = new QVBoxLayout{this};
    rows->setContentsMargins(Look::units(3), Look::units(2), Look::units(3), Look::units(2));
    rows->setSpacing(Look::units(1));
    rows->addWidget(bar_);
    empty_->show(tr("Drop numbers here"));
    hint_->show(tr("or choose “Plot” in the menu of a value (P)."));
    rows->addStretch(1);
    rows->addWidget(empty_, 0, Qt::AlignCenter);
    rows->addWidget(hint_, 0, Qt::AlignCenter);
    rows->addStretch(1);
    rows->addWidget(body_, 1000);

    auto* across = new QHBoxLayout{body_};
    across->setContentsMargins(0, 0, 0, 0);
    across->setSpacing(Look::units(1));
    across->addWidget(column_, 1);
    auto* side = new QScrollArea;
    side->setFrameShape(QFrame::NoFrame);
    side->setWidgetResizable(true);
    side->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    side_ = side;
    side->setFixedWidth(sideWidth(*legend_));
    side->setFocusPolicy(Qt::NoFocus);
    side->setWidget(legend_);
    across->addWidget(side);

    auto* down = new QVBoxLayout{column_};
    down->setSpacing(Look::units(1));
    stack_->setSpacing(Look::units(2));
    down->addLayout(stack_, 1);
    down->addWidget(lanes_);
    down->addWidget(axis_);
    down->addWidget(overview_);
    down->addWidget(foot_);
    lanes_->installEventFilter(pointer_);
    axis_->installEventFilter(pointer_);
}

// What was removed just now goes on being recorded, so that it can come back whole.
void PlotView::record() {
    std::vector<RecordedItem> wanted = lines_.recorded();
    const std::vector<RecordedItem> before = history_.recorded();
    wanted.insert(wanted.end(), before.begin(), before.end());
    std::ranges::sort(wanted);
    wanted.erase(std::ranges::unique(wanted).begin(), wanted.end());
    recorder_.record(this, std::move(wanted));
}

void PlotView::refresh(const std::shared_ptr<const Frame>& frame) {
    const bool other = !frame_ || frame_->structures != frame->structures;
    frame_ = frame;
    if (other && lines_.learn(*frame)) record();
    advance();
    if (isVisible()) redraw();
}

std::vector<DrawnLine> PlotView::drawn() const {
    std::vector<DrawnLine> result;
    const double now = range_.shown().to + range_.behind();
    for (const PlotLine& each : lines_.all()) {
        DrawnLine line{each, nullptr, nullptr, 0};
        if (each.known) {
            line.ring = recorder_.ring(each.item);
            line.time = recorder_.time(each.item.agent);
        }
        if (line.any() && line.ring->end() > line.ring->begin() &&
            now - line.time->secondsAt(line.ring->end() - 1) > silence) {
            line.silentUntil = now;
        }
        result.push_back(std::move(line));
    }
    return result;
}

void PlotView::fitPanels() {
    const int count = lines_.panels();
    while (static_cast<int>(panels_.size()) > count) {
        delete panels_.back()->parentWidget();
        panels_.pop_back();
        tags_.pop_back();
    }
    while (static_cast<int>(panels_.size()) < count) {
        auto* row = new QWidget;
        auto* across = new QHBoxLayout{row};
        across->setContentsMargins(0, 0, 0, 0);
        across->setSpacing(0);
        auto* panel = new PlotPanel;
        auto* tags = new TagStrip;
        tags->setFixedWidth(Look::units(5));
        across->addWidget(panel, 1);
        across->addWidget(tags);
        stack_->addWidget(row, 1);
        row->show();
        panel->canvas()->installEventFilter(pointer_);
        panel->canvas()->setMouseTracking(true);
        connect(tags, &TagStrip::dragged, this, &PlotView::dragTag);
        connect(tags, &TagStrip::dropped, this, &PlotView::dropTag);
        connect(tags, &TagStrip::givenUp, zone_, &QWidget::hide);
        panels_.push_back(panel);
        tags_.push_back(tags);
    }
    overlay_->raise();
}

// All canvases have the same edges; a panel without a right axis leaves its place free.
void PlotView::alignEdges() {
    double left = Look::length(19), right = 0;
    for (PlotPanel* each : panels_) {
        left = std::max(left, each->axisExtent(false));
        right = std::max(right, each->axisExtent(true));
    }
    left = std::ceil(left);
    for (PlotPanel* each : panels_) each->setAxisExtents(left, std::ceil(right));
    const QRect box = plotBox();
    lanes_->setEdges(box.left(), box.right() + 1);
    overview_->setEdges(box.left(), box.right() + 1);
}

QRect PlotView::plotBox() const {
    const int bottom = axis_->y();
    if (panels_.empty()) {
        const int left = Look::units(19), right = column_->width() - Look::units(5);
        return {left, 0, right - left, bottom};
    }
    const QRect canvas = panels_.front()->canvasBox();
    const QPoint corner = panels_.front()->mapTo(column_, canvas.topLeft());
    return {corner.x(), 0, canvas.width(), bottom};
}

double PlotView::secondsOfPixel() const { return range_.span() / std::max(plotBox().width(), 1); }

double PlotView::secondsAt(int x) const {
    return range_.shown().from + (x - plotBox().left()) * secondsOfPixel();
}

void PlotView::redraw() {
    const bool any = !lines_.all().empty();
    body_->setVisible(any);
    empty_->setVisible(!any);
    hint_->setVisible(!any);
    bar_->show(range_, {cursors_.shown, legend_->showsStatistics(), !side_->isHidden()});
    if (!any) return;
    fitPanels();
    column_->layout()->setContentsMargins(
        0, cursors_.shown ? CursorOverlay::bandHeight() : Look::units(1), 0, 0);
    const TimeSpan span = range_.shown();
    cursors_.pointer = pointer_->moment();
    const std::vector<DrawnLine> all = drawn();
    std::vector<DrawnLine> lanes;
    DrawnLine chosen;
    for (const DrawnLine& each : all) {
        if (each.line.lane) lanes.push_back(each);
        if (!each.line.lane && (!chosen.any() || each.line.tag == legend_->chosen())) chosen = each;
    }
    for (std::size_t i = 0; i < panels_.size(); ++i) {
        std::vector<DrawnLine> own;
        for (const DrawnLine& each : all) {
            if (each.line.panel == static_cast<int>(i)) own.push_back(each);
        }
        panels_[i]->show(std::move(own), span, range_.follows());
    }
    alignEdges();
    lanes_->show(std::move(lanes), recorder_, span);
    const QRect box = plotBox();
    axis_->show(span, box.left(), box.right() + 1);
    overview_->show(chosen, kept(), span);
    overlay_->setGeometry(column_->rect());
    overlay_->show(cursors_, span, box, chosen_);
    showTags();
    if (frames_++ % legendEvery == 0 || !range_.follows()) {
        legend_->show(all, recorder_, span, cursors_, range_.follows());
        showNotices();
    }
}

void PlotView::showTags() {
    for (std::size_t i = 0; i < panels_.size(); ++i) {
        std::vector<TagStrip::Tag> tags;
        for (const DrawnLine& each : panels_[i]->lines()) {
            double value = each.valueAt(range_.shown().to - secondsOfPixel());
            if (std::isnan(value)) value = each.newest();
            if (std::isnan(value)) continue;
            tags.push_back(
                {each.line.tag, each.line.pen(2).color(), panels_[i]->yOf(value, each.line.right)});
        }
        tags_[i]->show(std::move(tags));
    }
}

void PlotView::toggleCursors() {
    if (!range_.known()) return redraw();  // there is no moment yet
    cursors_.shown = !cursors_.shown;
    const TimeSpan span = range_.shown();
    if (cursors_.shown) {
        cursors_.a = span.from + span.length() / 3;
        cursors_.b = span.from + span.length() * 2 / 3;
        range_.hold();
    }
    chosen_ = 0;
    redraw();
}

void PlotView::showLegend(bool wanted) {
    side_->setVisible(wanted);
    redraw();
    Q_EMIT changed();
}

void PlotView::toggleStatistics() {
    legend_->showStatistics(!legend_->showsStatistics());
    side_->setVisible(side_->isVisible() || legend_->showsStatistics());
    frames_ = 0;
    redraw();
}

void PlotView::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter{this};
    painter.fillRect(rect(), Look::colours().surface);
}

void PlotView::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    redraw();
}

void PlotView::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() != QEvent::StyleChange && event->type() != QEvent::PaletteChange) return;
    if (side_ != nullptr) side_->setFixedWidth(sideWidth(*legend_));
    for (PlotPanel* each : panels_) each->restyle();
}

}  // namespace cortex::gui
