// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/archive.hpp"
#include "cortex/core/simplex.hpp"

#include "physics.hpp"

#include <cstdint>

namespace cortex::physics {

// A gripper that limits its force itself: where its jaws go, how hard they may press, and what it
// says of the work piece. m, s, N. Setup: constructor; the rest in a tick.
class WorldGripper {
public:
    WorldGripper(const OutputSimplex& status, double opening);

    // As at the start, at this opening.
    void reset(double opening) CORTEX_REALTIME;
    // In each cycle with the brakes off. Where its demand is not good, what was told last counts:
    // what it holds would fall otherwise. Jaws that press on something stand where that is and not
    // where they were told, so a demand that is led to them is no wish to let go.
    void follow(const JointDemand& wish, bool isGood, const JointState& jaws) CORTEX_REALTIME;
    JointDemand demand(bool braked) const CORTEX_REALTIME;
    // Once a cycle, after the step.
    void show(const JointState& jaws, double seconds) CORTEX_REALTIME;

    void keep(Archive& archive) CORTEX_REALTIME {
        archive & aim_ & speed_ & force_ & isLed_ & ledTo_ & place_ & rested_;
    }

private:
    // Numbers of the labels of `object` in ontology/robotics.xml.
    enum Object : std::int64_t { Moving, StoppedOpening, StoppedClosing, AtDemand };

    bool presses(const JointState& jaws) const CORTEX_REALTIME;
    bool isLedBack(double wish, const JointState& jaws) CORTEX_REALTIME;

    Data<std::int64_t> object_;
    double aim_ = 0, speed_ = 0, force_ = 0;
    bool isLed_ = false;  // its demand was led to the jaws that press, to this opening
    double ledTo_ = 0;
    double place_ = 0;   // from which the jaws have not moved away
    double rested_ = 0;  // s, since when
};

}  // namespace cortex::physics
