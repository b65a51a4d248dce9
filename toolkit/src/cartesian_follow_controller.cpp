// SPDX-License-Identifier: Apache-2.0
#include "cartesian_follow_controller.hpp"

#include <algorithm>

namespace cortex::toolkit {

void CartesianFollowController::populate() {
    hand_ = PoseInput{input("hand")};
    tip_ = PoseInput{input("tip")};
    target_ = PoseOutput{output("target")};
    enable_ = Enable{input("enable"), {hand_.state, tip_.state}};
    greatestDistance_ = data<const double>("greatestDistance");
    greatestAngle_ = data<const double>("greatestAngle");
    engaged_ = data<bool>("engaged");
    engageCount_ = data<std::int64_t>("engageCount");
    letGoCount_ = data<std::int64_t>("letGoCount");
    handPath_ = input("hand").path();
    for (const InputSimplex& axis : inputs("axes"))
        axes_.push_back({axis.path(), axis.data<std::int64_t>("status")});
}

bool CartesianFollowController::stateStartingUp(const Tick&) {
    pose_ = tip_.pose();
    enable_.reset();
    engaged_ = false;
    return true;
}

void CartesianFollowController::engage(bool engage) {
    if (engage && !engaged_) {
        handThen_ = hand_.pose();
        tipThen_ = tip_.pose();
        engageCount_ += 1;
    }
    engaged_ = engage;
}

void CartesianFollowController::followHand() {
    const Pose hand = hand_.pose();
    pose_.position = tipThen_.position + (hand.position - handThen_.position);
    pose_.rotation =
        (hand.rotation * handThen_.rotation.conjugate() * tipThen_.rotation).normalized();
}

EventText CartesianFollowController::tooFar(double distance, double angle) const {
    EventText text{"the tip is "};
    if (distance <= greatestDistance_)
        return text.apart(angle, greatestAngle_)
               << " rad from its target, allowed " << greatestAngle_.get();
    return text.apart(distance, greatestDistance_)
           << " m from its target, allowed " << greatestDistance_.get();
}

void CartesianFollowController::letGo(const EventText& why) {
    event(Severity::Warning,
          EventText{"lets go of "} << handPath_ << ": " << why.view() << "; press anew");
    enable_.reset();
    engaged_ = false;
    letGoCount_ += 1;
}

// Before anyone has read the target of this cycle, so not even a hand that jumps moves the arm.
// Without a press, too: drives that start again bring the tip to the target.
void CartesianFollowController::stayNear(const Pose& tip) {
    const double distance = (pose_.position - tip.position).norm();
    const double angle = pose_.rotation.angularDistance(tip.rotation);
    if (distance <= greatestDistance_ && angle <= greatestAngle_) return;
    if (engaged_) letGo(tooFar(distance, angle));
    pose_ = tip;
}

const CartesianFollowController::Axis* CartesianFollowController::firstStanding() const {
    const auto standing = std::ranges::find_if(
        axes_, [](const Axis& axis) { return !whyStanding(axis.status).empty(); });
    return standing == axes_.end() ? nullptr : &*standing;
}

void CartesianFollowController::stateActive(const Tick&) {
    const bool enabled = enable_.update(inputLost());
    const bool isKnown = tip_.state->quality == Quality::Good;
    if (const Axis* axis = firstStanding()) {
        if (engaged_)
            letGo(EventText{axis->path} << " does not follow: its drive says "
                                        << whyStanding(axis->status));
        enable_.reset();
        if (isKnown) pose_ = tip_.pose();
    } else {
        engage(enabled);
        if (engaged_) followHand();
        if (engaged_ || isKnown) stayNear(tip_.pose());
    }
    target_.write(pose_, engaged_ ? hand_.velocity() : Twist{Twist::Zero()});
}

bool CartesianFollowController::stateShuttingDown(const Tick&) {
    engaged_ = false;
    return true;
}

void CartesianFollowController::keep(Archive& archive) {
    archive.version("CartesianFollowController", 1);
    archive & enable_;
    for (Pose* pose : {&handThen_, &tipThen_, &pose_}) toolkit::keep(archive, *pose);
}

}  // namespace cortex::toolkit
