// SPDX-License-Identifier: Apache-2.0
#include "drive/homing_row.hpp"

#include "motion/labels.hpp"

#include <QEvent>
#include <QHBoxLayout>
#include <QProgressBar>
#include <QPushButton>
#include <QVBoxLayout>
#include <cmath>

namespace cortex::explorer {

namespace {

QString noteOf(const DriveAxis& axis, const Homing& homing, bool runs, const QString& whyNot) {
    QStringList parts;
    const QString method = HomingRow::tr("method %1").arg(axis.homingMethod);
    if (runs) {
        parts << method << HomingRow::tr("by %1").arg(homing.requester);
        return parts.join(QStringLiteral(", "));
    }
    const QString homed = !axis.homingNeeded ? HomingRow::tr("its encoder needs no homing")
                          : axis.homed       ? HomingRow::tr("homed")
                                             : HomingRow::tr("not homed");
    parts << (axis.live() ? homed : '[' + homed + ']');
    if (axis.homingNeeded) parts << method;
    if (!homing.outcome.isEmpty() && !homing.runs)
        parts << HomingRow::tr("the last one: %1").arg(homing.outcome);
    if (!whyNot.isEmpty() && axis.homingNeeded && axis.live()) parts << whyNot;
    return parts.join(QStringLiteral(", "));
}

}  // namespace

HomingRow::HomingRow(QWidget* parent)
    : QWidget{parent},
      home_{new QPushButton{tr("Home")}},
      cancel_{new QPushButton{tr("Cancel")}},
      bar_{new QProgressBar},
      percent_{new QLabel},
      note_{new Sentence{Tone::Quiet}} {
    bar_->setRange(0, 1000);
    bar_->setTextVisible(false);
    bar_->setAccessibleName(tr("Progress of the homing"));
    note_->keepLines(1);
    auto* row = new QHBoxLayout;
    row->setSpacing(units(2));
    row->addWidget(new QLabel{tr("Homing")});
    row->addWidget(home_);
    row->addWidget(bar_, 1);
    row->addWidget(percent_);
    row->addWidget(cancel_);
    row->addStretch(0);
    auto* rows = new QVBoxLayout{this};
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(0);
    rows->addLayout(row);
    rows->addWidget(note_);
    dress();
    connect(home_, &QPushButton::clicked, this, &HomingRow::homeWanted);
    connect(cancel_, &QPushButton::clicked, this, &HomingRow::cancelWanted);
}

void HomingRow::dress() {
    QFont small = font();
    small.setPointSizeF(font().pointSizeF() * 0.9);
    if (note_->font() != small) note_->setFont(small);
    percent_->setMinimumWidth(percent_->fontMetrics().horizontalAdvance(QStringLiteral("100 %")));
    bar_->setFixedHeight(units(2));
    bar_->setMinimumWidth(units(10));
    for (QPushButton* each : {home_, cancel_}) each->setFixedHeight(units(7.5));
}

void HomingRow::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::StyleChange || event->type() == QEvent::FontChange) dress();
}

// The two buttons never stand in one place: who presses Home twice cancels nothing.
void HomingRow::show(const DriveAxis& axis, const Homing& homing, bool runs,
                     const AxisReasons& reasons, const QString& whyNoCancel) {
    const QString& why = reasons.home;
    home_->setVisible(!runs);
    home_->setEnabled(why.isEmpty());
    home_->setToolTip(why);
    home_->setAccessibleDescription(why);
    for (QWidget* each : std::initializer_list<QWidget*>{bar_, percent_, cancel_})
        each->setVisible(runs);
    bar_->setValue(static_cast<int>(std::lround(homing.progress * bar_->maximum())));
    percent_->setText(tr("%1 %").arg(std::lround(homing.progress * 100)));
    cancel_->setEnabled(whyNoCancel.isEmpty());
    cancel_->setToolTip(whyNoCancel);
    note_->say(noteOf(axis, homing, runs, why == reasons.all ? QString{} : why));
}

}  // namespace cortex::explorer
