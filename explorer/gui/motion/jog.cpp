// SPDX-License-Identifier: Apache-2.0
#include "motion/jog.hpp"

#include <algorithm>
#include <utility>

namespace cortex::explorer {

using namespace std::chrono_literals;
using std::chrono::milliseconds;

namespace {

constexpr auto longestStep = 100ms, toldFor = 5000ms;

}  // namespace

Jog::Jog(MakeOrder order, Begin begin, QObject* parent)
    : QObject{parent}, order_{std::move(order)}, begin_{std::move(begin)} {}

// A command that comes too late expires, and does not move the axis later.
void Jog::start(QWidget& held, int axis, double velocity, double holdTime) {
    end(tr("let go"));
    if (hold_) hold_->deleteLater();  // it would stay with its button
    axis_ = axis;
    velocity_ = velocity;
    holdTime_ = holdTime;
    moved_ = false;
    started_ = std::chrono::steady_clock::now();
    const milliseconds lasts{static_cast<int>(holdTime * 1000)};
    HeldOrder order{order_(axis, velocity), std::clamp<milliseconds>(lasts / 3, 1ms, longestStep),
                    order_(axis, 0).arguments};
    order.order.budget = std::max(lasts, 1ms);
    said_.clear();
    hold_ = begin_(held, order);
    if (!hold_) return;
    if (!hold_->runs()) {
        say(tr("Not jogged: %1").arg(hold_->why()));
        return;
    }
    connect(hold_, &Hold::ended, this, [this, hold = hold_.data()] {
        if (hold == hold_ && said_.isEmpty()) say(tr("Ended: %1").arg(hold->why()));
    });
}

void Jog::change(double velocity) {
    if (!runs() || velocity == velocity_) return;
    velocity_ = velocity;
    hold_->change(order_(axis_, velocity).arguments);
}

void Jog::end(const QString& why) {
    if (!runs()) return;
    say(tr("Ended: %1").arg(why));
    hold_->end();
}

// Until the hold time has passed it may be the jog before this one.
void Jog::see(bool jogging) {
    if (!runs()) return;
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - started_;
    if (moved_ && !jogging) end(tr("the controller ended it"));
    moved_ = moved_ || (jogging && passed.count() > holdTime_);
}

QString Jog::said() const {
    const bool recent = std::chrono::steady_clock::now() - since_ < toldFor;
    return !runs() && recent ? said_ : QString{};
}

void Jog::say(const QString& text) {
    said_ = text;
    since_ = std::chrono::steady_clock::now();
}

}  // namespace cortex::explorer
