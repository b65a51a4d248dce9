// SPDX-License-Identifier: Apache-2.0
#include "mujoco_world.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace cortex::physics {
namespace {

constexpr double nearDemand = 0.01;      // rad or m between demand and axis
constexpr double startPatience = 1;      // s, until it tells that it waits
constexpr double mostSteps = 20;         // in a cycle
constexpr std::int64_t slowCycles = 10;  // in a row that need more: no standstill of the process
constexpr double farBeyond = 0.1;  // rad or m, behind the end of a range: no end stop gives so far
constexpr double roundingOfSteps = 1e-6;
constexpr double leastWeight = 1;   // N or N.m, that is worth a word
constexpr double sameWeight = 0.3;  // of it: so near is an effort that is to carry it

}  // namespace

// --- setup --------------------------------------------------------------------------------------

std::string MujocoWorld::modelText() const { return physics_ ? physics_->mjcf() : std::string{}; }

void MujocoWorld::populate() {
    const WorldRelations relations{path(),
                                   inputs("manipulators"),
                                   inputs("arms"),
                                   inputs("bodies"),
                                   inputs("demands"),
                                   outputs("observations"),
                                   outputs("bodyPoses"),
                                   outputs("statuses")};
    SceneMap map = readScene(relations);
    std::ranges::copy(array<const double>("gravity"), map.scene.gravity.begin());
    map.scene.timeStep = data<const double>("timeStep");
    map.scene.contactLimit = static_cast<int>(data<const std::int64_t>("contactLimit").get());
    physics_.emplace(map.scene);
    bindAxes(map, relations);
    noteLoose(map.scene);
    for (const OutputSimplex& pose : relations.bodyPoses)
        poses_.push_back({pose.array<double>("position"), pose.array<double>("rotation"),
                          pose.array<double>("linearVelocity"),
                          pose.array<double>("angularVelocity")});
    bindItems();
    show(0);
}

void MujocoWorld::bindAxes(const SceneMap& map, const WorldRelations& relations) {
    std::vector<const Joint*> joints;
    for (const Arm& arm : map.scene.arms)
        for (const Joint& joint : arm.joints) joints.push_back(&joint);
    const std::size_t ofArms = joints.size();
    for (const Gripper& gripper : map.scene.grippers) joints.push_back(&gripper.opening);
    gripOf_.assign(joints.size(), none);
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const std::size_t place = map.axes[i];
        axes_.emplace_back(relations.demands[place], relations.observations[place], *joints[i]);
        held_.push_back(joints[i]->start);
    }
    for (std::size_t i = 0; i < map.statuses.size(); ++i) {
        if (!map.statuses[i]) continue;
        gripOf_[ofArms + i] = grips_.size();
        grips_.emplace_back(relations.statuses[*map.statuses[i]], joints[ofArms + i]->start);
    }
    demands_.resize(axes_.size());
}

// It may be meant, but more likely an Arm was forgotten under `arms`.
void MujocoWorld::noteLoose(const Scene& scene) {
    for (const Gripper& gripper : scene.grippers) {
        if (scene.arms.empty() || gripper.carrier || gripper.opening.origin != Triple{}) continue;
        loose_ = EventText{gripper.path}
                 << " stands at the origin of the world, as no Arm under "
                    "arms carries it; relate one, or give an originPosition";
    }
}

void MujocoWorld::bindItems() {
    timeStep_ = data<const double>("timeStep");
    bandwidth_ = data<const double>("bandwidth");
    dampingRatio_ = data<const double>("dampingRatio");
    gravityCompensation_ = data<const bool>("gravityCompensation");
    for (const InputSimplex& safety : inputs("safety")) {
        emergencyStop_ = safety.data<bool>("emergencyStop");
        protectiveStop_ = safety.data<bool>("protectiveStop");
    }
    contacts_ = data<std::int64_t>("contacts");
    energy_ = data<double>("energy");
    braked_ = data<bool>("braked");
    on<&MujocoWorld::brake>("brake");
    on<&MujocoWorld::release>("release");
    on<&MujocoWorld::reset>("reset");
}

// --- states and commands ------------------------------------------------------------------------

bool MujocoWorld::isSafetyStop() const {
    return emergencyStop_.bound() && (emergencyStop_ || protectiveStop_);
}

void MujocoWorld::faultBySafety() {
    fault(safetyStop,
          emergencyStop_ ? "safety stop: emergency stop" : "safety stop: protective stop");
}

std::size_t MujocoWorld::firstAway() const {
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        if (!(axes_[i].away(physics_->joint(i)) < nearDemand)) return i;
    }
    return none;
}

EventText MujocoWorld::whyAway(std::size_t axis) const {
    const double away = axes_[axis].away(physics_->joint(axis));
    EventText text{axes_[axis].path()};
    if (!std::isfinite(away)) return text << " moves, or its demand does";
    return text << " is " << away << " " << axes_[axis].unit() << " from its demand";
}

// As drives do: it does not switch on while a demand is elsewhere.
bool MujocoWorld::stateStartingUp(const Tick& tick) {
    if (waited_ == 0 && !loose_.view().empty()) event(Severity::Warning, loose_);
    toldTwice_ = false;
    if (isSafetyStop()) {
        faultBySafety();
        return false;
    }
    const std::size_t away = firstAway();
    if (away == none && !inputLost()) return true;
    const bool tells = waited_ < startPatience;
    waited_ += tick.elapsedSeconds();
    if (!tells || waited_ < startPatience) return false;
    if (away == none)
        event(Severity::Warning, "it waits for an input that is lost");
    else
        event(Severity::Warning, EventText{"it waits: "}
                                     << whyAway(away).view()
                                     << "; a controller brings the two together");
    return false;
}

void MujocoWorld::stateActive(const Tick&) {
    if (isSafetyStop()) faultBySafety();
    if (!toldTwice_ && !braked_ && gravityCompensation_) tellIfCarriedTwice();
}

void MujocoWorld::tellIfCarriedTwice() {
    double weight = 0, difference = 0, most = 0;
    std::size_t heaviest = 0;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        const double load = physics_->load(i), effort = demands_[i].effort;
        if (gripOf_[i] != none || effort == 0) continue;
        if (std::abs(load) > most) {
            most = std::abs(load);
            heaviest = i;
        }
        weight += load * load;
        difference += (load - effort) * (load - effort);
    }
    toldTwice_ =
        weight > leastWeight * leastWeight && difference < sameWeight * sameWeight * weight;
    if (!toldTwice_) return;
    event(Severity::Warning,
          EventText{"the demand of "}
              << axes_[heaviest].path()
              << " carries its weight, and so does gravityCompensation: switch that off, or set "
                 "part of InverseDynamics to Acceleration");
}

Outcome MujocoWorld::brake(Call&) {
    isCommanded_ = true;
    return Outcome::Done;
}

Outcome MujocoWorld::release(Call& call) {
    const std::size_t away = firstAway();
    if (braked_ && away != none)
        return call.reject(Reason::State,
                           (EventText{whyAway(away)} << ": bring the two together first").view());
    isCommanded_ = false;
    return Outcome::Done;
}

Outcome MujocoWorld::reset(Call&) {
    physics_->reset();
    stands_ = false;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        held_[i] = axes_[i].start();
        if (gripOf_[i] != none) grips_[gripOf_[i]].reset(held_[i]);
    }
    return Outcome::Done;
}

// --- each cycle ---------------------------------------------------------------------------------

void MujocoWorld::loopEnd(const Tick& tick) {
    brakeWhereNeeded();
    lead();
    if (!stands_) step(tick);
    show(tick.elapsedSeconds());
    if (state() != State::StartingUp) waited_ = 0;
}

// After a loss they come off by themselves, once all demands are at their axes again.
void MujocoWorld::brakeWhereNeeded() {
    const bool isActive = state() == State::Active;
    isCommanded_ = isCommanded_ && isActive;
    isLost_ = isActive && (inputLost() || (isLost_ && firstAway() != none));
    const bool brakes = !isActive || isCommanded_ || isLost_;
    if (brakes && !braked_) {
        for (std::size_t i = 0; i < axes_.size(); ++i) held_[i] = physics_->joint(i).position;
    }
    braked_ = brakes;
}

void MujocoWorld::lead() {
    const bool brakes = braked_;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        const WorldAxis& axis = axes_[i];
        if (gripOf_[i] == none) {
            demands_[i] = brakes ? JointDemand{held_[i], 0, 0, true} : axis.wish();
            continue;
        }
        WorldGripper& grip = grips_[gripOf_[i]];
        if (!brakes) grip.follow(axis.wish(), axis.isGood(), physics_->joint(i));
        demands_[i] = grip.demand(brakes);
    }
}

void MujocoWorld::step(const Tick& tick) {
    const double longest = timeStep_;
    const double needed = std::ceil(tick.elapsedSeconds() / longest - roundingOfSteps);
    const double steps = std::clamp(needed, 1.0, mostSteps);
    tellIfSlow(needed > steps, tick);
    const double seconds =
        needed > steps ? steps * longest : tick.elapsedSeconds();  // the rest of the time is lost
    if (seconds <= 0) return;
    const Trouble trouble = physics_->step(seconds, static_cast<int>(steps), demands_,
                                           {bandwidth_, dampingRatio_, gravityCompensation_});
    if (trouble != Trouble::None) return fail(trouble, textOf(trouble));
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        if (axes_[i].beyond(physics_->joint(i)) > farBeyond)
            return fail(Trouble::Diverged,
                        EventText{"'"} << axes_[i].path()
                                       << "' was pushed through the end of its range; look at what "
                                          "pushes it, or stands in something at the start");
    }
}

void MujocoWorld::tellIfSlow(bool lacksSteps, const Tick& tick) {
    const bool isSlow = lacksSteps || tick.elapsed < tick.passed;
    slow_ = isSlow ? std::min(slow_ + 1, slowCycles + 1) : 0;
    if (slow_ != slowCycles) return;
    EventText text{"time is slower here than outside: "};
    if (lacksSteps)
        text << "a cycle has " << tick.elapsedSeconds() << " s, and " << mostSteps
             << " steps of timeStep are " << mostSteps * timeStep_.get() << " s; make timeStep "
             << tick.elapsedSeconds() / mostSteps << " s";
    else
        text << tick.passedSeconds() << " s passed since the last cycle, and it is worth "
             << tick.elapsedSeconds() << " s, as the loop misses ticks; give it a lower frequency";
    event(Severity::Warning, text);
}

EventText MujocoWorld::textOf(Trouble trouble) const {
    EventText text;
    if (trouble == Trouble::Error) text << "MuJoCo reports an error: ";
    return text << physics_->why();
}

void MujocoWorld::fail(Trouble trouble, const EventText& text) {
    if (state() != State::Fault) return fault(static_cast<std::int64_t>(trouble), text.view());
    stands_ = true;
    event(Severity::Error,
          EventText{"it fails again, so it stands still until reset: "} << text.view());
}

AxisStatus MujocoWorld::statusOf(std::size_t axis) const {
    if (state() == State::Fault) return AxisStatus::Fault;
    if (braked_) return AxisStatus::Braked;
    return axes_[axis].statusOf(physics_->joint(axis));
}

void MujocoWorld::show(double seconds) {
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        const JointState now = physics_->joint(i);
        axes_[i].show(now, statusOf(i));
        if (gripOf_[i] != none) grips_[gripOf_[i]].show(now, seconds);
    }
    for (std::size_t i = 0; i < poses_.size(); ++i) {
        const BodyState body = physics_->body(i);
        std::ranges::copy(body.position, poses_[i].position.begin());
        std::ranges::copy(body.rotation, poses_[i].rotation.begin());
        std::ranges::copy(body.linearVelocity, poses_[i].linearVelocity.begin());
        std::ranges::copy(body.angularVelocity, poses_[i].angularVelocity.begin());
    }
    contacts_ = physics_->contacts();
    energy_ = physics_->energy();
}

void MujocoWorld::keep(Archive& archive) {
    archive.version("MujocoWorld", 1);
    physics_->keep(archive);
    archive & held_ & waited_ & slow_ & toldTwice_ & isCommanded_ & isLost_ & stands_ & grips_;
}

}  // namespace cortex::physics
