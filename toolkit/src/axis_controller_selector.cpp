// SPDX-License-Identifier: Apache-2.0
#include "cortex/toolkit/axis_controller_selector.hpp"

#include <algorithm>

namespace cortex::toolkit {

void AxisControllerSelector::populate() {
    group_ = array<const std::int64_t>("group");
    selected_ = data<std::int64_t>("selected");
    switchCount_ = data<std::int64_t>("switchCount");
    newGroup_ = argument<std::int64_t>("select", "group");
    on<&AxisControllerSelector::select>("select");
    for (const OutputSimplex& choice : outputs("choices"))
        choices_.push_back(lifeCycle(choice, true));
    wanted_ = group_[0];
}

bool AxisControllerSelector::stateStartingUp(const Tick&) {
    step_ = HandOver::Starting;
    return true;
}

bool AxisControllerSelector::want(std::int64_t group) {
    const auto members = group_.first(choices_.size());
    if (std::ranges::find(members, group) == members.end()) return false;
    wanted_ = group;
    step_ = HandOver::Starting;
    return true;
}

AxisControllerSelector::HandOver AxisControllerSelector::exchange(std::int64_t group,
                                                                  const Tick& tick) {
    return LifeCycleSender::handOver(
        choices_, [this, group](std::size_t place) { return group_[place] == group; }, tick);
}

void AxisControllerSelector::stateActive(const Tick& tick) {
    step_ = exchange(wanted_, tick);
    const bool works = step_ == HandOver::Stopping || step_ == HandOver::Done;
    if (works && selected_ != wanted_) {
        if (selected_ != 0) switchCount_ += 1;
        selected_ = wanted_;
    }
    if (step_ == HandOver::Failed && selected_ != 0 && selected_ != wanted_) {
        event(Severity::Warning,
              EventText{"group "} << wanted_ << " did not start; " << selected_ << " goes on");
        wanted_ = selected_;
    }
}

Outcome AxisControllerSelector::select(Call& call) {
    const std::int64_t group = call[newGroup_];
    if (call.first()) {
        if (!want(group)) {
            const EventText why = EventText{"no controller is in group "} << group;
            return call.reject(Reason::Range, why.view());
        }
        return Outcome::Running;
    }
    if (call.cancelling()) {
        if (selected_ != 0) wanted_ = selected_;
        return Outcome::Cancelled;
    }
    if (wanted_ != group || step_ == HandOver::Failed)
        return call.fail("it did not start; the group before goes on");
    return step_ == HandOver::Done ? Outcome::Done : Outcome::Running;
}

bool AxisControllerSelector::stateShuttingDown(const Tick& tick) {
    selected_ = 0;
    return exchange(0, tick) == HandOver::Done;
}

bool AxisControllerSelector::stateFault(const Tick& tick) { return stateShuttingDown(tick); }

void AxisControllerSelector::keep(Archive& archive) {
    archive.version("AxisControllerSelector", 1);
    archive & choices_ & wanted_ & step_;
}

}  // namespace cortex::toolkit
