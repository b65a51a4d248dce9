// SPDX-License-Identifier: Apache-2.0
#include "cartesian_follow_controller.hpp"

namespace cortex::toolkit {

void CartesianFollowController::populate() {
    hand_ = PoseInput{input("hand")};
    tip_ = PoseInput{input("tip")};
    target_ = PoseOutput{output("target")};
    enable_ = Enable{input("enable"), {hand_.state, tip_.state}};
    engaged_ = data<bool>("engaged");
    engageCount_ = data<std::int64_t>("engageCount");
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

void CartesianFollowController::stateActive(const Tick&) {
    engage(enable_.update(inputLost()));
    Twist velocity = Twist::Zero();
    if (engaged_) {
        const Pose hand = hand_.pose();
        pose_.position = tipThen_.position + (hand.position - handThen_.position);
        pose_.rotation =
            (hand.rotation * handThen_.rotation.conjugate() * tipThen_.rotation).normalized();
        velocity = hand_.velocity();
    }
    target_.write(pose_, velocity);
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
