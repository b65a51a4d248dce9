// SPDX-License-Identifier: Apache-2.0
#include "process/ramp.hpp"

#include <algorithm>
#include <cmath>

namespace cortex::toolkit {

void Ramp::populate() {
    item_ = itemName(*this, "item");
    const OutputSimplex result = output("result");
    path_ = result.path();
    result_ = ScalarOutput{result, item_};
    range_ = NumberRange{*result.type().findData(item_)};
    rate_ = data<const double>("rate");
    target_ = data<double>("target");
    remaining_ = data<double>("remaining");
    progress_ = data<double>("progress");
    newTarget_ = argument<double>("goTo", "target");
    on<&Ramp::goTo>("goTo");
}

bool Ramp::stateStartingUp(const Tick&) {
    begins_ = true;
    return true;
}

// From what went out, so that a limit or another writer is no step.
void Ramp::stateActive(const Tick& tick) {
    const double before = result_.before();
    if (begins_) target_ = before;
    begins_ = false;
    const double step = result_.step(rate_, tick.elapsedSeconds());
    const double now = std::clamp<double>(target_, before - step, before + step);
    remaining_ = rate_ > 0 ? std::abs(target_ - now) / rate_ : 0.0;
    result_.write(now);
}

bool Ramp::mayGoTo(Call& call, double target) const {
    EventText why{"target is "};
    if (!(rate_ > 0)) {
        call.reject(Reason::State, "rate is 0: set it first");
    } else if (target < range_.least || target > range_.greatest) {
        const bool above = target > range_.greatest;
        const double limit = above ? range_.greatest : range_.least;
        why.apart(target, limit) << (above ? ", above " : ", below ");
        why.apart(limit, target) << ", the limit of " << path_ << "." << item_;
        call.reject(Reason::Range, why.view());
    } else {
        return true;
    }
    return false;
}

Outcome Ramp::goTo(Call& call) {
    const double now = result_.before();
    if (call.first()) {
        const double target = call[newTarget_];
        if (!mayGoTo(call, target)) return Outcome::Rejected;
        from_ = now;
        target_ = target;
    }
    if (call.cancelling()) {
        target_ = now;
        return Outcome::Cancelled;
    }
    const double way = std::abs(target_ - from_);
    progress_ = way > 0 ? std::min(std::abs(now - from_) / way, 1.0) : 1.0;
    return now == target_ ? Outcome::Done : Outcome::Running;
}

void Ramp::keep(Archive& archive) {
    archive.version("Ramp", 1);
    archive & from_ & begins_;
}

}  // namespace cortex::toolkit
