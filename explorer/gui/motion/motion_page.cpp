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

QScrollArea* scrolled(const QString& name) {
    auto* area = new QScrollArea;
    area->setWidgetResizable(true);
    area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    area->setFocusPolicy(Qt::NoFocus);
    area->setMinimumHeight(1);  // the lines below are never cut
    area->setAccessibleName(name);
    return area;
}

}  // namespace

MotionPage::MotionPage(const std::vector<QWidget*>& column, QWidget* parent)
    : QWidget{parent},
      left_{scrolled(tr("Axes"))},
      right_{scrolled(tr("The last seconds"))},
      side_{new QWidget},
      plots_{new AxisPlots},
      jogging_{new Plate},
      ended_{new Sentence{Tone::Quiet}},
      hint_{new Sentence{Tone::Quiet}} {
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
    top->addWidget(lines());
    arrange();
}

QWidget* MotionPage::lines() {
    auto* box = new QWidget;
    auto* column = new QVBoxLayout{box};
    column->setContentsMargins(units(4), 0, units(4), 0);
    column->setSpacing(units(0.5));
    for (QWidget* each : std::initializer_list<QWidget*>{jogging_, ended_, hint_})
        column->addWidget(each);
    return box;
}

bool MotionPage::settled() const { return plots_->length() >= settledAfter; }

void MotionPage::reveal(QWidget& part) { left_->ensureWidgetVisible(&part, 0, units(2)); }

void MotionPage::say(const QString& jogging, const QString& ended, const QString& hint,
                     std::optional<Tone> tone) {
    // Where there is room, a line for it stays free: no button moves when a jog begins.
    jogging_->keepPlace(height() >= units(lowUnits));
    jogging_->say(jogging);
    ended_->say(ended);
    ended_->setVisible(!ended.isEmpty());
    hint_->say(hint, tone);
    // Where there is little room, one of them at a time.
    const bool crowded = height() < units(lowUnits) && (!jogging.isEmpty() || !ended.isEmpty());
    hint_->setVisible(!crowded && !hint.isEmpty());
}

// Beside the axes where there is room, otherwise below them.
void MotionPage::arrange() {
    left_->setMinimumWidth(units(leastRowUnits + 4));  // with its scroll bar
    const bool wide = width() >= units(wideUnits);
    if (wide == (right_->widget() == side_)) return;
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
