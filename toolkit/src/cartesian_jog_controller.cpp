// SPDX-License-Identifier: Apache-2.0
#include "cortex/toolkit/cartesian_jog_controller.hpp"

#include "cortex/core/error.hpp"

#include "handles.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace cortex::toolkit {

using mechanics::MotionLimits;
using mechanics::MotionState;
using JointVector = SerialChain::JointVector;

namespace {

constexpr std::size_t ofElbow = 6;

// Of an axis' A and J: what a change of the pace takes, and what the bends of its way. The pace
// makes up for a bend that sharpens, which takes half as much again. So all axes can follow at one
// pace, and the tip goes straight.
constexpr double shareOfPace = 0.5, shareOfBend = 0.25, shareOfBendsJerk = 0.05;
constexpr double shareOfSpeed = 0.95;  // of V, for the same reason
// Of what the pace may: what it slows down by before the end of its way, and what it could at most.
constexpr double shareOfBraking = 0.3, shareOfStop = 0.5;
constexpr double closest = 2 * mechanics::lostBelow;  // where it stops before a lost direction
constexpr double negligible = 1e-3;                   // share of a velocity
constexpr double leastNeed = 0.02;                    // share of the joints' velocity

// The greatest velocity from which a stop takes no more than the way, as with a trapezoid of the
// acceleration: a step of the velocity by v takes v/A + A/J, or 2·sqrt(v/J) below A²/J.
double fastestStopWithin(double way, const MotionLimits& limits) {
    if (way <= 0) return 0;
    const double a = limits.acceleration, j = limits.jerk;
    if (!std::isfinite(j)) return std::sqrt(2 * a * way);
    const double edge = a * a / j;  // of the velocity: below, A is not reached
    if (way <= edge * std::sqrt(edge / j)) return std::cbrt(way * way * j);
    return -edge / 2 + std::sqrt(edge * edge / 4 + 2 * a * way);
}

// Whether a cycle leads from one state to the next within the limits, and on below the velocity.
bool reaches(const MotionState& before, const MotionState& next, const MotionLimits& limits,
             double seconds) {
    const double swing = next.acceleration * std::abs(next.acceleration) / (2 * limits.jerk);
    return std::abs(next.acceleration) <= limits.acceleration &&
           std::abs(next.acceleration - before.acceleration) <= limits.jerk * seconds &&
           std::abs(next.velocity + swing) <= limits.velocity;
}

MotionLimits shareOf(const MotionLimits& limits, double share) {
    return {limits.velocity, share * limits.acceleration, share * limits.jerk};
}

// The greatest p with speed·p + gain·p² <= most.
double below(double most, double speed, double gain) {
    if (gain == 0) return speed == 0 ? 1 : most / speed;
    return (std::sqrt(speed * speed + 4 * gain * most) - speed) / (2 * gain);
}

double lengthOf(std::span<const double> motion) {
    double squares = 0;
    for (const double velocity : motion) squares += velocity * velocity;
    return std::sqrt(squares);
}

double limitedTo(double value, double most) { return std::clamp(value, -most, most); }

}  // namespace

void CartesianJogController::populate() {
    AxisController::populate();
    const auto axes = inputs("axes");
    chain_ = chainOf(*this, axes, array<const double>("tipPosition"),
                     array<const double>("tipRotation"));
    readDirections();
    joints_ = elbow_ = JointVector::Zero(static_cast<Eigen::Index>(axisCount()));
    next_.resize(axisCount());
    frame_ = data<const std::int64_t>("frame");
    holdTime_ = data<const double>("holdTime");
    linearSpeed_ = data<const double>("linearSpeed");
    angularSpeed_ = data<const double>("angularSpeed");
    elbowSpeed_ = data<const double>("elbowSpeed");
    rampTime_ = data<const double>("rampTime");
    manipulability_ = data<double>("manipulability");
    singularDistance_ = data<double>("singularDistance");
    heldBack_ = data<std::int64_t>("heldBack");
    jogging_ = data<bool>("jogging");
    linear_ = arrayArgument<double>("jog", "linear");
    angular_ = arrayArgument<double>("jog", "angular");
    elbowVelocity_ = argument<double>("elbow", "velocity");
    on<&CartesianJogController::jog>("jog");
    on<&CartesianJogController::elbow>("elbow");
    on<&CartesianJogController::halt>("halt");
}

void CartesianJogController::readDirections() {
    const auto stated = array<const bool>("directions");
    std::copy(stated.begin(), stated.end(), directions_.begin());
    const int counted = mechanics::count(directions_);
    if (counted >= 1 && static_cast<std::size_t>(counted) <= axisCount()) return;
    throw Error(path() + ": " + std::to_string(axisCount()) + " axes cannot follow " +
                std::to_string(counted) +
                " directions: set in the item directions which of x y z and the turns about them "
                "count, such as \"true true true false false false\"");
}

// --- motion -----------------------------------------------------------------------------------

MotionLimits CartesianJogController::limitsOf(std::size_t motion) const {
    const double speed = motion < 3 ? linearSpeed_ : motion < ofElbow ? angularSpeed_ : elbowSpeed_;
    const double ramp = rampTime_;
    return {speed, 2 * speed / ramp, 4 * speed / (ramp * ramp)};
}

// In motion it only becomes faster or slower: another direction, or frame, begins from rest.
void CartesianJogController::aim() {
    jogging_ = held_.lasts(now_);
    drives_ = jogging_;
    if (!jogging_) return;
    const bool rests = pace_.velocity == 0 && pace_.acceleration == 0;
    const double was = lengthOf(direction_), is = lengthOf(aim_);
    double alike = 0;
    for (std::size_t i = 0; i < motions; ++i) alike += aim_[i] * direction_[i];
    drives_ = rests || (usedFrame_ == frame_ && alike > (1 - 1e-9) * was * is);
    if (!drives_) return;
    usedFrame_ = frame_;
    mostPace_ = rests ? 1 : std::min(1.0, is / was);
    if (mostPace_ < 1) return;
    if (!rests) {  // faster: as it is, it becomes a smaller share
        pace_.velocity *= was / is;
        pace_.acceleration *= was / is;
    }
    direction_ = aim_;
}

// Of the joints, at pace 1.
mechanics::TipVelocity CartesianJogController::wanted(const JointVector& joints) {
    const Pose tip = chain_->forward(joints, jacobian_);
    if (usedFrame_ == Tip) {
        const Eigen::Matrix3d back = tip.rotation.conjugate().toRotationMatrix();
        for (Eigen::Index i = 0; i < jacobian_.cols(); ++i) {
            jacobian_.col(i).head<3>() = back * jacobian_.col(i).head<3>().eval();
            jacobian_.col(i).tail<3>() = back * jacobian_.col(i).tail<3>().eval();
        }
    }
    Twist twist;
    for (std::size_t i = 0; i < ofElbow; ++i)
        twist[static_cast<Eigen::Index>(i)] = directions_[i] ? direction_[i] : 0.0;
    mechanics::TipVelocity found = mechanics::jointVelocities(jacobian_, twist, directions_);
    if (direction_[ofElbow] == 0) return found;
    // An arm with more axes than six keeps the turn of its tip, too, whatever counts.
    constexpr mechanics::Directions all{true, true, true, true, true, true};
    elbow_ = mechanics::selfMotion(jacobian_, axisCount() > ofElbow ? all : directions_, elbow_);
    found.joints += direction_[ofElbow] * elbow_;
    return found;
}

// From where the joints are at the end of this cycle, and a small way further.
CartesianJogController::Course CartesianJogController::course() {
    Course course{wanted(joints_), JointVector::Zero(joints_.size())};
    const double speed = course.now.joints.norm();
    if (speed == 0) return course;
    constexpr double way = 1e-4;  // rad or m
    const double time = way / speed;
    const auto ahead = wanted(joints_ + time * course.now.joints);
    course.bend = (ahead.joints - course.now.joints) / time;
    course.loses = (ahead.lost - course.now.lost) / time;
    for (std::size_t i = 0; i < course.falls.size(); ++i)
        course.falls[i] = (course.now.values[i] - ahead.values[i]) / time;
    return course;
}

// The pace may change as the tip's ramp says, and as each axis can follow.
MotionLimits CartesianJogController::paceLimits(const JointVector& joints) const {
    constexpr double any = 1e9;  // per s², per s³: of a direction that is not moved
    MotionLimits ramp{1, any, any};
    const auto include = [&ramp](double speed, double acceleration, double jerk) {
        if (speed == 0) return;
        ramp.acceleration = std::min(ramp.acceleration, acceleration / std::abs(speed));
        ramp.jerk = std::min(ramp.jerk, jerk / std::abs(speed));
    };
    for (std::size_t i = 0; i < motions; ++i) {
        const MotionLimits tip = limitsOf(i);
        include(direction_[i], tip.acceleration, tip.jerk);
    }
    for (std::size_t i = 0; i < axisCount(); ++i) {
        const MotionLimits axis = limits(i).motion();
        include(joints[static_cast<Eigen::Index>(i)], shareOfPace * axis.acceleration,
                shareOfPace * axis.jerk);
    }
    return ramp;
}

// The greatest pace at which no axis is too fast, and each can follow the bends of its way.
void CartesianJogController::keepOnWay(const Course& course, Pace& pace) const {
    const bool near = course.now.smallest() < 4 * closest * course.now.largest();
    const HeldBack why = near ? Singularity : Speed;
    const double turning = course.bend.norm() / course.now.joints.norm();  // per s, at pace 1
    for (std::size_t i = 0; i < axisCount(); ++i) {
        const double velocity = course.now.joints[static_cast<Eigen::Index>(i)];
        const double bend = course.bend[static_cast<Eigen::Index>(i)];
        const MotionLimits axis = limits(i).motion();
        const double gain = velocity * bend > 0 ? axis.acceleration / axis.jerk / 2 : 0;
        pace.atMost(below(shareOfSpeed * axis.velocity, std::abs(velocity), gain * std::abs(bend)),
                    why);
        if (bend == 0) continue;
        pace.atMost(std::sqrt(shareOfBend * axis.acceleration / std::abs(bend)), why);
        pace.atMost(std::cbrt(shareOfBendsJerk * axis.jerk / (std::abs(bend) * turning)), why);
    }
}

// The way, in s at pace 1, before an axis is at a limit or the chain loses a direction.
void CartesianJogController::keepBeforeEnds(const Course& course, Pace& pace) {
    for (std::size_t i = 0; i < axisCount(); ++i) {
        const double velocity = course.now.joints[static_cast<Eigen::Index>(i)];
        if (velocity == 0) continue;
        const double position = demands()[i].position;
        const double way = velocity > 0 ? limits(i).max - position : position - limits(i).min;
        pace.endsAfter(way / std::abs(velocity), Limit);
    }
    const double left = negligible - course.now.lost;
    if (left <= 0) pace.atMost(0, Singularity);
    if (course.loses > 0) pace.endsAfter(left / course.loses / 2, Singularity);
    for (std::size_t i = 0; i < static_cast<std::size_t>(course.now.counted); ++i) {
        if (course.falls[i] <= 0 || course.now.needs[i] < leastNeed) continue;
        // Half: the smallest value falls the faster, the smaller it is.
        const double way = course.now.values[i] - closest * course.now.largest();
        pace.endsAfter(way / course.falls[i] / 2, Singularity);
    }
}

// The next pace: no more than that, and such that a stop ends before its way does.
void CartesianJogController::step(Pace pace, double seconds) {
    const MotionLimits braking = shareOf(pace.limits, shareOfBraking);
    const MotionLimits stopping = shareOf(pace.limits, shareOfStop);
    pace.atMost(fastestStopWithin(pace.way - pace_.velocity * seconds, braking), pace.end);
    // Joints that become fast on the way leave less of it.
    pace_.acceleration = limitedTo(pace_.acceleration, pace.limits.acceleration);
    const auto next = mechanics::planVelocity(pace_, pace.most, pace.limits);
    const auto stop = mechanics::planVelocity(pace_, 0, pace.limits);
    if (!next || !stop) {
        pace_ = {};
        return;
    }
    const MotionState faster = next->at(seconds);
    const auto after = mechanics::planVelocity(faster, 0, stopping);
    const bool ends = after && after->end().position <= pace.way;
    if (!ends) pace.why = pace.end;
    pace_ = drives_ && ends ? faster : stop->at(seconds);
    pace_.position = 0;
    heldBack_ = jogging_ ? pace.why : Nothing;
}

// Where an axis cannot follow in this cycle, the pace becomes one that all can have. False: there
// is none.
bool CartesianJogController::stayTogether(const JointVector& joints, double before,
                                          double mostChange, double seconds) {
    constexpr double inside = 1 - 1e-6;  // of the limits, for rounding
    double low = -1e9, high = 1e9;
    for (std::size_t i = 0; i < axisCount(); ++i) {
        const double velocity = joints[static_cast<Eigen::Index>(i)];
        if (velocity == 0) continue;
        const MotionLimits most = limits(i).motion();
        const MotionState& axis = demands()[i];
        const double change = inside * most.jerk * seconds, all = inside * most.acceleration;
        const double least = std::max(axis.acceleration - change, -all) * seconds;
        const double greatest = std::min(axis.acceleration + change, all) * seconds;
        const double one = (axis.velocity + least) / velocity;
        const double other = (axis.velocity + greatest) / velocity;
        low = std::max(low, std::min(one, other));
        high = std::min(high, std::max(one, other));
    }
    if (low > high || high < 0) return std::abs(pace_.velocity) < 0.01;
    const double pace = std::clamp(pace_.velocity, std::max(low, 0.0), high);
    if (pace == pace_.velocity) return true;
    pace_.velocity = pace;
    pace_.acceleration = limitedTo((pace - before) / seconds, mostChange);
    return true;
}

// Each axis by its own limits. False, and nothing is moved: one could not stop before its range
// ends.
bool CartesianJogController::stepAll(const JointVector& velocities, double seconds) {
    for (std::size_t i = 0; i < axisCount(); ++i) {
        const MotionLimits most = limits(i).motion();
        const MotionState& before = demands()[i];
        const double velocity = limitedTo(velocities[static_cast<Eigen::Index>(i)], most.velocity);
        const double acceleration = (velocity - before.velocity) / seconds;
        const double position = before.position + (before.velocity + velocity) / 2 * seconds;
        next_[i] = {position, velocity, acceleration};
        if (!reaches(before, next_[i], most, seconds)) {
            const auto step = mechanics::planVelocity(before, velocity, most);
            if (!step) return false;
            next_[i] = step->at(seconds);
        }
        const auto stop = mechanics::planVelocity(next_[i], 0, most);
        if (!stop || !limits(i).inRange(stop->end().position)) return false;
    }
    std::ranges::copy(next_, demands().begin());
    return true;
}

// Also where it is not Active, or an axis is lost: then move() is not called.
void CartesianJogController::loopStart(const Tick&) { jogging_ = false; }

void CartesianJogController::takeOver(const Tick& tick) {
    held_.end(now_, tick.nominalTime);
    stop();
}

void CartesianJogController::move(const Tick& tick) {
    now_ = tick.nominalTime;
    const double seconds = tick.elapsedSeconds();
    for (std::size_t i = 0; i < axisCount(); ++i) {
        const MotionState& axis = demands()[i];
        joints_[static_cast<Eigen::Index>(i)] = axis.position + axis.velocity * seconds;
    }
    aim();
    const Course way = course();
    manipulability_ = way.now.manipulability;
    singularDistance_ = way.now.smallest();
    Pace pace{.limits = paceLimits(way.now.joints), .most = mostPace_};
    keepOnWay(way, pace);
    keepBeforeEnds(way, pace);
    const double before = pace_.velocity;
    step(pace, seconds);
    const bool together = stayTogether(way.now.joints, before, pace.limits.acceleration, seconds);
    if (together && stepAll(pace_.velocity * way.now.joints, seconds)) return;
    held_.end(now_, now_);
    brakeAll(seconds);
}

// Each axis by itself, as fast as it can; a jog that goes on begins anew from there.
void CartesianJogController::brakeAll(double seconds) {
    stop();
    heldBack_ = Limit;
    for (std::size_t i = 0; i < axisCount(); ++i) {
        const auto brake = mechanics::planVelocity(demands()[i], 0, limits(i).motion());
        demands()[i] = brake ? brake->at(seconds) : MotionState{demands()[i].position, 0, 0};
    }
}

void CartesianJogController::stop() {
    direction_ = {};
    pace_ = {};
}

// --- commands ---------------------------------------------------------------------------------

// A velocity of zero ends the jog: the tip comes to rest on its straight way.
Outcome CartesianJogController::moveAs(Call& call, const Motion& motion) {
    const bool moves = std::ranges::any_of(motion, [](double velocity) { return velocity != 0; });
    if (!held_.begin(call, holdTime_, moves)) return Outcome::Rejected;
    aim_ = motion;
    return Outcome::Done;
}

Outcome CartesianJogController::jog(Call& call) {
    if (!allFollow(call)) return Outcome::Rejected;
    const auto linear = call[linear_], angular = call[angular_];
    Motion motion{};
    for (std::size_t i = 0; i < 3; ++i) {
        if ((linear[i] != 0 && !directions_[i]) || (angular[i] != 0 && !directions_[i + 3]))
            return call.reject(Reason::Range, "directions says that one of these does not count");
        motion[i] = limitedTo(linear[i], linearSpeed_);
        motion[i + 3] = limitedTo(angular[i], angularSpeed_);
    }
    return moveAs(call, motion);
}

Outcome CartesianJogController::elbow(Call& call) {
    if (!allFollow(call)) return Outcome::Rejected;
    if (axisCount() <= static_cast<std::size_t>(mechanics::count(directions_)))
        return call.reject(Reason::State, "no axis is to spare: each is needed for the tip");
    Motion motion{};
    motion[ofElbow] = limitedTo(call[elbowVelocity_], elbowSpeed_);
    return moveAs(call, motion);
}

Outcome CartesianJogController::halt(Call&) {
    held_.end(now_, now_);
    stop();
    return Outcome::Done;
}

void CartesianJogController::keep(Archive& archive) {
    AxisController::keep(archive);
    archive.version("CartesianJogController", 3);
    archive & direction_ & aim_ & pace_ & mostPace_ & usedFrame_ & held_;
    archive.time(now_);
    toolkit::keep(archive, elbow_);
}

}  // namespace cortex::toolkit
