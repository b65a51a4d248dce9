// SPDX-License-Identifier: Apache-2.0
#include "inverse_dynamics.hpp"

#include "cortex/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace cortex::toolkit {
namespace {

using mechanics::RigidBody;

constexpr double startTolerance = 0.01;  // rad or m, between target and demand
constexpr double nearlyStill = 1e-3;     // rad/s or m/s
constexpr double startPatience = 1;      // s
constexpr std::int64_t accelerationAlone = 1;

RigidBody bodyOf(double mass, std::span<const double> centre, std::span<const double> inertia) {
    return {mass, Eigen::Map<const Eigen::Vector3d>{centre.data()},
            Eigen::Map<const RigidBody::Inertia>{inertia.data()}};
}

RigidBody linkOf(const Simplex& owner, const InputSimplex& axis) {
    const RigidBody link = bodyOf(axis.data<double>("linkMass"), axis.array<double>("linkCentre"),
                                  axis.array<double>("linkInertia"));
    const std::string rule = owner.path() + ": rule 'axes': " + axis.path();
    if (link.mass == 0) {
        throw Error(rule + " states no mass of its link: give linkMass in its type '" +
                    axis.type().name + "', or set it in the system file");
    }
    if (const std::string_view why = finding(link); !why.empty()) {
        throw Error(rule + ", its link: " + std::string{why});
    }
    return link;
}

mechanics::InverseDynamics dynamicsOf(const Simplex& owner, const std::vector<InputSimplex>& axes,
                                      std::span<const double> gravity) {
    std::vector<mechanics::DynamicJoint> joints;
    for (const mechanics::ChainJoint& joint : chainJoints(owner, axes)) {
        const InputSimplex& axis = axes[joints.size()];
        joints.push_back({joint, linkOf(owner, axis), axis.data<double>("armature"),
                          axis.data<double>("damping")});
    }
    try {
        return {joints, Eigen::Map<const Eigen::Vector3d>{gravity.data()}};
    } catch (const std::invalid_argument& error) {
        throw Error(owner.path() + ": " + error.what());
    }
}

}  // namespace

// What was latched at the start may not have gone out yet, so both count.
double InverseDynamics::Joint::away() const {
    return std::max(std::abs(targetPosition - acceptedPosition),
                    std::abs(targetPosition - demand.position));
}

bool InverseDynamics::Joint::isThere() const {
    return away() < startTolerance && std::abs(targetVelocity) < nearlyStill &&
           std::abs(acceptedVelocity) < nearlyStill;
}

void InverseDynamics::populate() {
    FollowAxisController::populate();
    dynamics_.emplace(dynamicsOf(*this, inputs("axes"), array<const double>("gravity")));
    findJoints();
    for (auto* each : {&positions_, &velocities_, &accelerations_, &none_})
        *each = SerialChain::JointVector::Zero(dynamics_->size());
    part_ = data<const std::int64_t>("part");
    loadMass_ = data<const double>("loadMass");
    loadCentre_ = array<const double>("loadCentre");
    loadInertia_ = array<const double>("loadInertia");
    settingsChanged();
}

void InverseDynamics::findJoints() {
    const auto targets = inputs("targets");
    const auto demands = outputs("demands");
    for (std::size_t i = 0; i < demands.size(); ++i) {
        joints_.push_back({targets[i].path(), demands[i].path(),
                           targets[i].data<double>("position"), targets[i].data<double>("velocity"),
                           demands[i].accepted<double>("position"),
                           demands[i].accepted<double>("velocity"), AxisOutput{demands[i]}});
    }
}

bool InverseDynamics::stateStartingUp(const Tick& tick) {
    FollowAxisController::stateStartingUp(tick);
    const auto waitsFor = std::ranges::find_if_not(joints_, &Joint::isThere);
    if (waitsFor == joints_.end()) return true;
    const bool tells = waited_ < startPatience;
    waited_ += tick.elapsedSeconds();
    if (tells && waited_ >= startPatience) tellWaiting(*waitsFor);
    return false;
}

void InverseDynamics::tellWaiting(const Joint& joint) {
    EventText text{"it waits for the target "};
    text << joint.targetPath;
    if (joint.away() < startTolerance)
        text << ", as it or its demand still moves";
    else
        text << ", " << joint.away() << " away from " << joint.demandPath << "; bring it there";
    event(Severity::Warning, text);
}

void InverseDynamics::loopEnd(const Tick&) {
    if (state() != State::StartingUp) waited_ = 0;
    if (state() == State::Active) writeEfforts();
}

void InverseDynamics::writeEfforts() {
    for (std::size_t i = 0; i < joints_.size(); ++i) {
        const auto joint = static_cast<Eigen::Index>(i);
        positions_[joint] = joints_[i].demand.position;
        velocities_[joint] = joints_[i].demand.velocity;
        accelerations_[joint] = joints_[i].demand.acceleration;
    }
    SerialChain::JointVector efforts = dynamics_->torques(positions_, velocities_, accelerations_);
    if (part_ == accelerationAlone) efforts -= dynamics_->torques(positions_, velocities_, none_);
    for (std::size_t i = 0; i < joints_.size(); ++i)
        joints_[i].demand.effort = efforts[static_cast<Eigen::Index>(i)];
}

void InverseDynamics::settingsProposed(ProposedSettings& proposed) {
    const std::string_view why =
        finding(bodyOf(proposed[loadMass_], proposed[loadCentre_], proposed[loadInertia_]));
    if (!why.empty()) proposed.refuse((EventText{"the load: "} << why).view());
}

void InverseDynamics::settingsChanged() {
    dynamics_->setLoad(bodyOf(loadMass_, loadCentre_, loadInertia_));
}

void InverseDynamics::keep(Archive& archive) {
    FollowAxisController::keep(archive);
    archive.version("InverseDynamics", 1);
    archive & waited_;
}

}  // namespace cortex::toolkit
