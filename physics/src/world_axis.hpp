// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/archive.hpp"
#include "cortex/core/simplex.hpp"

#include "physics.hpp"
#include "scene.hpp"

#include <cstdint>
#include <string>

namespace cortex::physics {

// Numbers of the labels of an axis' status in ontology/robotics.xml.
enum class AxisStatus : std::int64_t { Ready = 1, Moving = 2, AtLimit = 3, Fault = 4, Braked = 7 };

// One axis of a world: demand and observation, in rad or m, s, and N.m or N. Setup: constructor;
// the rest in a tick.
class WorldAxis {
public:
    WorldAxis(const InputSimplex& demand, const OutputSimplex& observation, const Joint& joint);

    const std::string& path() const { return path_; }
    const char* unit() const { return isRotary_ ? "rad" : "m"; }
    double start() const { return start_; }

    // What its demand asks for, and whether that may be followed anew.
    JointDemand wish() const CORTEX_REALTIME;
    bool isGood() const CORTEX_REALTIME { return slot_->quality == Quality::Good; }
    // Between it and its demand; infinite while one of them moves.
    double away(const JointState& now) const CORTEX_REALTIME;

    // How far behind the end of its range; below 0: within it.
    double beyond(const JointState& now) const CORTEX_REALTIME;

    // Shows the state. An end stop gives way a little, as it is computed, so a position is shown
    // within its range. A drive at its greatest speed overshoots a little, which is not shown; more
    // than that is, as what is pushed or falls may be faster.
    void show(const JointState& now, AxisStatus status) CORTEX_REALTIME;
    // Of an axis whose brake is off.
    AxisStatus statusOf(const JointState& now) const CORTEX_REALTIME;

private:
    std::string path_;
    bool isRotary_;
    double start_, min_, max_, mostEffort_;
    double slowest_ = 0, fastest_ = 0;  // as its type states its velocity
    const SlotState* slot_;
    Data<const double> wishedPosition_, wishedVelocity_, wishedEffort_;
    Data<double> position_, velocity_, acceleration_, effort_;
    Data<std::int64_t> status_;
};

}  // namespace cortex::physics
