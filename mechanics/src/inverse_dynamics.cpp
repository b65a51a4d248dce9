// SPDX-License-Identifier: Apache-2.0
#include "cortex/mechanics/inverse_dynamics.hpp"

#include "joint_geometry.hpp"

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

#include <Eigen/Eigenvalues>

namespace cortex::mechanics {
namespace {

// Of the largest principal moment: what decimal numbers lose.
constexpr double momentRounding = 1e-9;

Eigen::Matrix3d matrixOf(const RigidBody::Inertia& inertia) {
    Eigen::Matrix3d matrix;
    matrix << inertia[0], inertia[3], inertia[4],  //
        inertia[3], inertia[1], inertia[5],        //
        inertia[4], inertia[5], inertia[2];
    return matrix;
}

// Of a body about another point, `away` from its centre of mass (theorem of Steiner).
Eigen::Matrix3d shifted(const RigidBody& body, const Eigen::Vector3d& away) {
    return matrixOf(body.inertia) +
           body.mass * (away.squaredNorm() * Eigen::Matrix3d::Identity() - away * away.transpose());
}

bool isNoNegativeNumber(double value) { return std::isfinite(value) && value >= 0; }

std::string dynamicsFindings(const std::vector<DynamicJoint>& joints,
                             const Eigen::Vector3d& gravity) {
    std::string text = countFinding(joints.size());
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const DynamicJoint& each = joints[i];
        text += geometryFindings(i, each.joint);
        if (const std::string_view why = finding(each.link); !why.empty()) {
            text += jointFinding(i, std::string{why});
        }
        if (!isNoNegativeNumber(each.armature)) {
            text += jointFinding(i, "armature is not finite or below 0: give 0 or more");
        }
        if (!isNoNegativeNumber(each.damping)) {
            text += jointFinding(i, "damping is not finite or below 0: give 0 or more");
        }
    }
    if (!gravity.allFinite()) text += "\n  gravity is not finite: give numbers";
    return text;
}

}  // namespace

std::string_view finding(const RigidBody& body) {
    if (!std::isfinite(body.mass) || !body.centre.allFinite() || !body.inertia.allFinite()) {
        return "mass, centre or inertia is not finite: give numbers";
    }
    if (body.mass < 0) return "mass is below 0: give 0 or more";
    if (body.mass == 0) {
        return body.inertia.isZero(0) ? "" : "inertia without a mass: give the mass, too";
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver{matrixOf(body.inertia),
                                                                Eigen::EigenvaluesOnly};
    const Eigen::Vector3d moments = solver.eigenvalues();  // the smallest first
    const double rounding = momentRounding * moments.cwiseAbs().maxCoeff();
    if (!(moments[0] >= -rounding)) {
        return "inertia has a principal moment below 0: check its numbers and their order, "
               "xx yy zz xy xz yz";
    }
    if (!(moments[0] + moments[1] >= moments[2] - rounding)) {
        return "inertia has a principal moment above the sum of the other two: give it about the "
               "centre of mass";
    }
    return "";
}

InverseDynamics::InverseDynamics(const std::vector<DynamicJoint>& joints,
                                 const Eigen::Vector3d& gravity)
    : gravity_{gravity} {
    if (const std::string text = dynamicsFindings(joints, gravity); !text.empty()) {
        throw std::invalid_argument("inverse dynamics refused:" + text);
    }
    links_.reserve(joints.size());
    for (const DynamicJoint& each : joints) {
        links_.push_back({fromRollPitchYaw(each.joint.originRotation), each.joint.origin,
                          each.joint.direction.normalized(), each.joint.kind == JointKind::Rotary,
                          each.link.mass, each.link.centre, matrixOf(each.link.inertia),
                          each.armature, each.damping});
    }
    lastLink_ = joints.back().link;
}

bool InverseDynamics::setLoad(const RigidBody& load) {
    if (!finding(load).empty()) return false;
    Link& last = links_.back();
    last.mass = lastLink_.mass + load.mass;
    last.centre = lastLink_.centre;
    if (load.mass > 0) last.centre += load.mass / last.mass * (load.centre - lastLink_.centre);
    last.inertia = shifted(lastLink_, lastLink_.centre - last.centre) +
                   shifted(load, load.centre - last.centre);
    return true;
}

// How the link before moves, in its own frame. Gravity is a base that rises.
struct InverseDynamics::Motion {
    Eigen::Vector3d rise;  // acceleration of its origin
    Eigen::Vector3d turn = Eigen::Vector3d::Zero();
    Eigen::Vector3d turnChange = Eigen::Vector3d::Zero();
};

// Where a link is in the frame of the link before, and what moves it, in its own frame.
struct InverseDynamics::Moved {
    Eigen::Matrix3d rotation;
    Eigen::Vector3d offset;
    Eigen::Vector3d force;
    Eigen::Vector3d moment;  // about its origin
};

InverseDynamics::Moved InverseDynamics::move(const Link& link, const JointState& joint,
                                             Motion& motion) {
    Moved moved{link.rotation, link.offset, {}, {}};
    if (link.rotary)
        moved.rotation *= Eigen::AngleAxisd(joint.position, link.direction).toRotationMatrix();
    else
        moved.offset += link.rotation * (joint.position * link.direction);
    const Eigen::Matrix3d back = moved.rotation.transpose();
    auto& [rise, turn, turnChange] = motion;
    rise = back * (rise + turnChange.cross(moved.offset) + turn.cross(turn.cross(moved.offset)));
    turn = back * turn;
    turnChange = back * turnChange;
    const Eigen::Vector3d speed = joint.velocity * link.direction;
    const Eigen::Vector3d change = joint.acceleration * link.direction;
    if (link.rotary) {
        turnChange += turn.cross(speed) + change;
        turn += speed;
    } else {
        rise += 2 * turn.cross(speed) + change;
    }
    const Eigen::Vector3d& centre = link.centre;
    moved.force = link.mass * (rise + turnChange.cross(centre) + turn.cross(turn.cross(centre)));
    const Eigen::Vector3d spin = link.inertia * turn;
    moved.moment = link.inertia * turnChange + turn.cross(spin) + centre.cross(moved.force);
    return moved;
}

InverseDynamics::JointVector InverseDynamics::torques(const JointVector& positions,
                                                      const JointVector& velocities,
                                                      const JointVector& accelerations) const {
    assert(positions.size() == size() && velocities.size() == size() &&
           accelerations.size() == size());
    std::array<Moved, SerialChain::maxJoints> moved;
    Motion motion{-gravity_};
    for (std::size_t i = 0; i < links_.size(); ++i) {  // outwards
        const auto joint = static_cast<Eigen::Index>(i);
        moved[i] =
            move(links_[i], {positions[joint], velocities[joint], accelerations[joint]}, motion);
    }
    JointVector efforts(positions.size());
    for (std::size_t i = links_.size(); i-- > 0;) {  // inwards
        const Link& link = links_[i];
        const auto joint = static_cast<Eigen::Index>(i);
        efforts[joint] = link.direction.dot(link.rotary ? moved[i].moment : moved[i].force) +
                         link.armature * accelerations[joint] + link.damping * velocities[joint];
        if (i == 0) break;
        const Eigen::Vector3d force = moved[i].rotation * moved[i].force;
        moved[i - 1].force += force;
        moved[i - 1].moment += moved[i].rotation * moved[i].moment + moved[i].offset.cross(force);
    }
    return efforts;
}

}  // namespace cortex::mechanics
