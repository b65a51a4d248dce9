// SPDX-License-Identifier: Apache-2.0
#include "motion/axis_plots.hpp"

#include "cortex/explorer/small_plot.hpp"
#include "cortex/explorer/theme.hpp"

#include <QLabel>
#include <QVBoxLayout>

namespace cortex::explorer {

namespace {

constexpr double span = 10;  // s

std::optional<double> shownAs(const ShownNumber& shown, std::optional<double> number) {
    return number ? std::optional{shown.of(*number)} : std::nullopt;
}

}  // namespace

AxisPlots::AxisPlots(QWidget* parent)
    : QWidget{parent}, title_{new QLabel}, rows_{new QVBoxLayout{this}} {
    rows_->setContentsMargins(0, 0, 0, 0);
    title_->setTextFormat(Qt::PlainText);
    QFont strong = font();
    strong.setWeight(QFont::DemiBold);
    title_->setFont(strong);
    title_->setMinimumWidth(1);
    rows_->addWidget(title_);
}

// A long name gives way, so that the plots are never wider than there is room.
void AxisPlots::entitle() {
    if (name_.isEmpty()) return;
    const QString whole = tr("%1, last 10 s").arg(name_);
    const int spare = title_->fontMetrics().horizontalAdvance(whole) - width();
    const int wide = title_->fontMetrics().horizontalAdvance(name_) - spare;
    const QString name =
        spare <= 0 ? name_ : title_->fontMetrics().elidedText(name_, Qt::ElideMiddle, wide);
    title_->setText(tr("%1, last 10 s").arg(name));
    title_->setToolTip(name == name_ ? QString{} : whole);
}

void AxisPlots::resizeEvent(QResizeEvent* /*event*/) { entitle(); }

void AxisPlots::forget(std::size_t axes) {
    past_.assign(axes, {});
    unit_.clear();
    for (SmallPlot* each : {position_, velocity_}) delete each;
    position_ = velocity_ = nullptr;
}

void AxisPlots::add(const std::vector<MotionAxis>& axes, double seconds) {
    for (std::size_t i = 0; i < past_.size() && i < axes.size(); ++i) {
        const MotionAxis& axis = axes[i];
        Moment moment{seconds, {}, {}, {}};
        if (axis.live) {
            moment.position = axis.position;
            moment.velocity = axis.velocity;
        }
        if (axis.demandLive) moment.wished = axis.wished;
        past_[i].push_back(moment);
        while (past_[i].front().seconds < seconds - span - 1) past_[i].pop_front();
    }
}

double AxisPlots::length() const {
    const bool any = !past_.empty() && !past_.front().empty();
    return any ? past_.front().back().seconds - past_.front().front().seconds : 0;
}

// A plot has one unit and one axis from its beginning.
void AxisPlots::begin(const MotionAxis& axis, const ShownNumber& position,
                      const ShownNumber& velocity) {
    for (SmallPlot* each : {position_, velocity_}) delete each;
    name_ = axis.name;
    entitle();
    position_ = new SmallPlot{tr("position"), position.unit.text};
    velocity_ = new SmallPlot{tr("velocity"), velocity.unit.text};
    position_->addLine(tr("now"));
    position_->addLine(tr("target"), true);
    position_->setLimits(shownAs(position, axis.min), shownAs(position, axis.max));
    velocity_->addLine(tr("now"));
    rows_->addWidget(position_, 3);
    rows_->addWidget(velocity_, 2);
}

void AxisPlots::put(const Moment& moment, const ShownNumber& position,
                    const ShownNumber& velocity) {
    position_->put(0, moment.seconds, shownAs(position, moment.position));
    position_->put(1, moment.seconds, shownAs(position, moment.wished));
    velocity_->put(0, moment.seconds, shownAs(velocity, moment.velocity));
}

void AxisPlots::show(const MotionAxis& axis, std::size_t index, const ShownNumber& position,
                     const ShownNumber& velocity) {
    if (index >= past_.size() || past_[index].empty()) return;
    if (position_ == nullptr || index != shown_ || unit_ != position.unit.text) {
        shown_ = index;
        unit_ = position.unit.text;
        begin(axis, position, velocity);
        for (const Moment& each : past_[index]) put(each, position, velocity);
    } else {
        put(past_[index].back(), position, velocity);
    }
    position_->setNow(past_[index].back().seconds);
    velocity_->setNow(past_[index].back().seconds);
}

}  // namespace cortex::explorer
