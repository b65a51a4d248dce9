// SPDX-License-Identifier: Apache-2.0
#include "motion/motion_page.hpp"

#include "motion/axis_plots.hpp"
#include "motion/labels.hpp"
#include "motion/row_columns.hpp"

#include <QBoxLayout>
#include <QScrollArea>

namespace cortex::explorer {

namespace {

constexpr double wideUnits = 195;   // from here on the plot stands beside the axes
constexpr double lowUnits = 80;     // below it there is room for one line only
constexpr double settledAfter = 5;  // s, of the plots
constexpr int lineCount = 2;        // of each sentence

QScrollArea* scrolled(const QString& name) {
    auto* area = new QScrollArea;
    area->setWidgetResizable(true);
    area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    // What is in it may be lower where it is narrower: a bar that comes and goes would never rest.
    area->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOn);
    area->setFocusPolicy(Qt::NoFocus);
    area->setMinimumHeight(1);  // the lines below are never cut
    area->setAccessibleName(name);
    return area;
}

}  // namespace

MotionPage::MotionPage(const std::vector<QWidget*>& column, bool jogs, QWidget* parent)
    : QWidget{parent},
      jogs_{jogs},
      left_{scrolled(tr("Axes"))},
      right_{scrolled(tr("The last seconds"))},
      side_{new QWidget},
      plots_{new AxisPlots},
      jogging_{new Plate},
      ended_{new Sentence{Tone::Quiet}},
      hint_{new Sentence{Tone::Quiet}},
      lines_{new QGridLayout} {
    auto* table = new QWidget;
    auto* rows = new QVBoxLayout{table};
    rows->setContentsMargins(0, 0, 0, 0);
    for (QWidget* each : column) rows->addWidget(each);
    rows->addStretch(1);
    left_->setWidget(table);
    auto* side = new QVBoxLayout{side_};
    side->setContentsMargins(units(3), 0, units(4), 0);
    side->addWidget(plots_);
    auto* body = new QHBoxLayout;
    body->setSpacing(0);
    body->addWidget(left_, 4);
    body->addWidget(right_, 3);
    auto* top = new QVBoxLayout{this};
    top->setContentsMargins(0, units(2), 0, units(2));
    top->setSpacing(units(1));
    top->addLayout(body, 1);
    top->addLayout(lines_);
    addLines();
    arrange();
}

// A jog, or why it ended, in one place; what else is to be known below it.
void MotionPage::addLines() {
    lines_->setContentsMargins(units(4), 0, units(4), 0);
    lines_->setVerticalSpacing(units(0.5));
    for (Sentence* each : {ended_, hint_}) {
        each->setAlignment(Qt::AlignTop | Qt::AlignLeft);
        each->keepLines(lineCount);
    }
    jogging_->keepLines(lineCount);
    lines_->addWidget(jogging_, 0, 0);
    lines_->addWidget(ended_, 0, 0);
}

bool MotionPage::isLow() const { return height() < units(lowUnits); }

bool MotionPage::settled() const { return plots_->length() >= settledAfter; }

void MotionPage::reveal(QWidget& part) { left_->ensureWidgetVisible(&part, 0, units(2)); }

void MotionPage::say(const QString& jogging, const QString& ended, const QString& hint,
                     std::optional<Tone> tone) {
    jogging_->say(jogging);
    ended_->say(ended);
    ended_->setVisible(jogging.isEmpty() && !ended.isEmpty());
    hint_->say(hint, tone);
    const bool crowded = isLow() && (!jogging.isEmpty() || !ended.isEmpty());
    hint_->setVisible(!crowded && !hint.isEmpty());
}

// The plots beside the axes where there is room, otherwise below them. Where there is little, all
// lines share one place.
void MotionPage::arrange() {
    lines_->addWidget(hint_, isLow() || !jogs_ ? 0 : 1, 0);
    left_->setMinimumWidth(units(leastRowUnits + 4));  // with its scroll bar
    const bool wide = width() >= units(wideUnits);
    const bool placed = side_->parentWidget() != nullptr;
    if (placed && wide == (right_->widget() == side_)) return;
    if (wide) {
        right_->setWidget(side_);
    } else {
        if (right_->widget() == side_) right_->takeWidget();
        auto* column = qobject_cast<QBoxLayout*>(left_->widget()->layout());
        column->insertWidget(column->count() - 1, side_);
    }
    right_->setVisible(wide);
    side_->show();
}

void MotionPage::resizeEvent(QResizeEvent* /*event*/) { arrange(); }

}  // namespace cortex::explorer
