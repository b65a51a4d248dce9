// SPDX-License-Identifier: Apache-2.0
// What the view of axes shows of them.
#include "motion/axis_view.hpp"
#include "motion/choices.hpp"
#include "motion/demand_bar.hpp"
#include "motion/motion_bar.hpp"
#include "motion/motion_page.hpp"

#include <QPushButton>
#include <algorithm>
#include <cmath>
#include <ranges>

namespace cortex::explorer {

namespace {

constexpr int mostTold = 2;  // demands that are wrong

bool isDemands(const QString& mode) { return mode == QLatin1String{"Position"}; }

}  // namespace

ShownNumber AxisView::positionOf(const MotionAxis& axis) const {
    return shownNumber(shownUnit(axis.positionUnit));
}

ShownNumber AxisView::velocityOf(const MotionAxis& axis) const {
    return shownNumber(shownUnit(axis.velocityUnit));
}

std::optional<double> AxisView::demandOf(int axis) const {
    const auto index = static_cast<std::size_t>(axis);
    if (demands_->has(index)) return demands_->entered(index);
    return index < sent_.size() ? std::optional{sent_[index]} : std::nullopt;
}

bool AxisView::hasTarget() const {
    if (given_) return true;
    const auto entered = [this](int i) { return demands_->has(static_cast<std::size_t>(i)); };
    return jogs_ ? entered(rows_->selected())
                 : std::ranges::any_of(std::views::iota(0, rows_->count()), entered);
}

// The controller has the last word: what is beyond a limit is marked, and can be sent.
QString AxisView::wrongDemand(int index) const {
    const auto demand = demandOf(index);
    if (!demand)
        return demands_->has(static_cast<std::size_t>(index)) ? tr("no number") : QString{};
    const MotionAxis& each = axis(index);
    if (each.max && *demand > *each.max)
        return tr("above its limit of %1").arg(positionOf(each).withUnit(*each.max));
    if (each.min && *demand < *each.min)
        return tr("below its limit of %1").arg(positionOf(each).withUnit(*each.min));
    return {};
}

// In the titles where all axes have one unit.
void AxisView::showTitles() {
    QString unit;
    bool one = true;
    for (const MotionAxis& each : axes_) {
        const QString its = positionOf(each).unit.text;
        one = one && (unit.isEmpty() || unit == its);
        unit = its;
    }
    const QString behind = one && !unit.isEmpty() ? QStringLiteral(" (%1)").arg(unit) : QString{};
    const bool demands = !jogs_ || isDemands(mode_);
    unitsInRows_ = behind.isEmpty();
    rows_->setTitles(tr("Value") + behind, tr("Target") + behind,
                     demands ? tr("Demand") + behind : tr("Hold to jog"));
    bar_->angles().show(shownUnit("rad").factor == 1 ? QStringLiteral("rad")
                                                     : QStringLiteral("deg"));
    bar_->lengths().show(shownUnit("m").factor == 1 ? QStringLiteral("m") : QStringLiteral("mm"));
}

void AxisView::showRows() {
    for (int i = 0; i < rows_->count(); ++i) showRow(i);
    bar_->saySpeed(speedText());
}

void AxisView::showRow(int index) {
    const MotionAxis& each = axis(index);
    RowLook look{positionOf(each), velocityOf(each)};
    look.nameWidth = rows_->nameWidth();
    look.unitInRow = unitsInRows_;
    look.selected = index == rows_->selected();
    look.focused = rows_->hasFocus();
    look.held = jog_->runs() && jog_->axis() == index ? jog_->direction() : 0;
    look.whyNot = whyNoJog(index);
    look.edited = demands_->isMarked(static_cast<std::size_t>(index));
    look.entered = demandOf(index);
    look.wrong = wrongDemand(index);
    rows_->row(index).show(each, look);
}

QString AxisView::speedText() const {
    if (rows_->count() == 0) return {};
    const int index = jog_->runs() ? jog_->axis() : rows_->selected();
    const auto most = rows_->row(index).most();
    if (!most) return {};
    const ShownNumber velocity = velocityOf(axis(index));
    return tr("%1: %2 of %3")
        .arg(axis(index).name, velocity.text(*most * bar_->share()), velocity.withUnit(*most));
}

QString AxisView::limitSentence() const {
    QStringList all;
    for (int i = 0; i < rows_->count(); ++i) {
        const MotionAxis& each = axis(i);
        for (const int direction : {1, -1}) {
            if (!each.isAtLimit(direction)) continue;
            const QString limit = positionOf(each).withUnit(direction > 0 ? *each.max : *each.min);
            all << (direction > 0
                        ? tr("%1 is at its upper limit of %2: + is off until it has left it.")
                        : tr("%1 is at its lower limit of %2: − is off until it has left it."))
                       .arg(each.name, limit);
        }
    }
    return all.join(' ');
}

void AxisView::showLines() {
    const bool jogs = jogs_ && !isDemands(mode_);
    QString jogging;
    if (jog_->runs()) {
        const MotionAxis& each = axis(jog_->axis());
        jogging = tr("Jogging %1 at %2. It brakes when you let go, after %3 s at the latest.")
                      .arg(each.name, velocityOf(each).withSign(jog_->velocity()))
                      .arg(jog_->holdTime());
    }
    QString hint;
    Tone tone = Tone::Quiet;
    const QString limits = jogs ? limitSentence() : QString{};
    if (!whyNot_.isEmpty() && !jog_->runs()) {
        hint = whyNot_;
    } else if (!limits.isEmpty()) {
        const QString why = whyNoJog(rows_->selected());  // a limit does not hide it
        hint = why.isEmpty() ? limits
                             : tr("%1 %2: %3.").arg(limits, axis(rows_->selected()).name, why);
        tone = Tone::Limit;
    } else if (jogs && rows_->count() > 0) {
        hint = tr("← → jog %1 while they are held, ↑ ↓ choose the axis.")
                   .arg(axis(rows_->selected()).name);
    }
    page_->say(jogging, jog_->said(), hint, tone);
    if (!jogs_) return;
    const bool usual = mode_ == QLatin1String{"Velocity"} || isDemands(mode_) || mode_.isEmpty();
    bar_->sayMode(!usual              ? tr("It is %1. To jog, press Velocity.").arg(mode_)
                  : whyNot_.isEmpty() ? QString{}
                                      : tr("It is %1.").arg(mode_));
}

void AxisView::showDemands() {
    const bool shown = !jogs_ || isDemands(mode_);
    demands_->setVisible(shown);
    if (!shown || rows_->count() == 0) return;
    const QString action = jogs_ ? tr("Move %1").arg(axis(rows_->selected()).name) : tr("Move");
    const QString why = !whyNot_.isEmpty()    ? whyNot_
                        : demands_->isWrong() ? tr("What was entered is no number")
                        : !hasTarget()        ? tr("enter a target, or Copy current")
                                              : QString{};
    const int share = qRound(bar_->share() * 100);
    QStringList wrong;
    for (int i = 0; i < rows_->count(); ++i) {
        const QString what = wrongDemand(i);
        if (!what.isEmpty()) wrong << tr("%1: %2.").arg(axis(i).name, what);
    }
    const int more = wrong.size() - mostTold;
    if (more > 0) wrong = wrong.mid(0, mostTold) << tr("%1 more are wrong.").arg(more);
    QString note = demands_->counts();
    if (wrong.isEmpty()) note += tr(", %1 % of the speed").arg(share);
    if (remaining_ && *remaining_ > 0) note += tr(", there in %1 s").arg(*remaining_, 0, 'f', 1);
    demands_->show(action, why, wrong.join(' '), note);
    const QString whyNoHalt = whyNot(path_, jogs_ ? "halt" : "cancel");
    demands_->haltButton().setEnabled(whyNoHalt.isEmpty());
}

}  // namespace cortex::explorer
