// SPDX-License-Identifier: Apache-2.0
// What the view of axes sends.
#include "motion/axis_view.hpp"
#include "motion/choices.hpp"
#include "motion/demand_bar.hpp"
#include "motion/motion_bar.hpp"
#include "motion/motion_page.hpp"

#include <QLineEdit>
#include <algorithm>

namespace cortex::explorer {

namespace {

constexpr std::int64_t positionMode = 1, velocityMode = 2;

std::optional<std::size_t> movedBy(int axis) {
    return axis < 0 ? std::nullopt : std::optional{static_cast<std::size_t>(axis)};
}

}  // namespace

void AxisView::choose(int axis) {
    if (jog_->runs() && axis != jog_->axis()) jog_->end(tr("another axis was chosen"));
    rows_->select(axis);
    page_->reveal(rows_->row(axis));
    showRows();
}

double AxisView::speedOf(int axis) const {
    return rows_->row(axis).most().value_or(0) * bar_->share();
}

// Why an axis cannot be jogged at all, in whatever direction.
QString AxisView::whyNoJog(int axis) const {
    if (!whyNot_.isEmpty()) return whyNot_;
    if (mode_ != QLatin1String{"Velocity"}) return tr("needs the mode Velocity");
    if (!rows_->row(axis).most())
        return tr("needs a greatest speed, which its type does not state");
    const auto drive = this->axis(axis).drive;
    if (drive && *drive != State::Active) {
        return tr("its drive is in %1").arg(QLatin1String{name(*drive)});
    }
    return {};
}

void AxisView::press(int axis, int direction, QWidget* held) {
    choose(axis);
    const QString why = whyNoJog(axis);
    if (!why.isEmpty()) {
        jog_->say(tr("Not jogged: %1").arg(why));
    } else if (this->axis(axis).isAtLimit(direction)) {
        jog_->say(tr("Not jogged: %1").arg(this->axis(axis).limitText()));
    } else {
        jog_->start(*held, axis, direction * speedOf(axis), holdTime_);
    }
    showRow(axis);
    showLines();
}

void AxisView::setMode(const QString& mode) {
    const bool position = mode == QLatin1String{"Position"};
    send({path_, "setMode", {{"mode", position ? positionMode : velocityMode}}},
         [this](const Answer& answer) {
             if (!answer.done) jog_->say(tr("The mode was not changed: %1").arg(answer.text));
         });
}

void AxisView::enter(int axis) {
    const QString text = rows_->row(axis).field().text();
    demands_->enter(static_cast<std::size_t>(axis), positionOf(this->axis(axis)).entered(text));
    rows_->select(axis);
    showRows();
    showDemands();
}

void AxisView::copyCurrent() {
    for (int i = 0; i < rows_->count(); ++i) {
        const MotionAxis& each = axis(i);
        if (!each.position) continue;
        demands_->enter(static_cast<std::size_t>(i), each.position);
        rows_->row(i).field().setText(positionOf(each).text(*each.position));
    }
    showRows();
    showDemands();
}

// What was entered is set first, all of it at once; what the controller refuses is not commanded.
void AxisView::move() {
    std::vector<double> demands = sent_;
    for (int i = 0; i < rows_->count() && i < static_cast<int>(demands.size()); ++i) {
        demands[static_cast<std::size_t>(i)] =
            demandOf(i).value_or(demands[static_cast<std::size_t>(i)]);
    }
    Arguments items{{item_, demands}};
    if (jogs_) items.emplace("speedShare", std::vector{bar_->share()});
    demands_->say({});
    const int axis = jogs_ ? rows_->selected() : -1;
    const int motion = demands_->send(movedBy(axis));
    send({path_, "set", items}, [this, axis, motion](const Answer& answer) {
        if (answer.done) {
            go(axis, motion);
        } else {
            tell(motion, answer);
        }
    });
}

// One axis, or all of them at once.
void AxisView::go(int axis, int motion) {
    demands_->taken(motion, movedBy(axis));
    const auto told = [this, motion](const Answer& answer) { tell(motion, answer); };
    if (jogs_) {
        send({path_, "go", {{"axis", std::int64_t{axis} + 1}}}, told);
    } else {
        send({path_, "moveTo", {{"speedShare", bar_->share()}}}, told);
    }
}

void AxisView::tell(int motion, const Answer& answer) {
    demands_->answer(motion, answer.done);
    demands_->say(answer.text);
    showRows();
    showDemands();
}

}  // namespace cortex::explorer
