// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/mechanics/inverse_dynamics.hpp"
#include "cortex/toolkit/axis_controllers.hpp"

#include "handles.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cortex::toolkit {

// Passes targets on as a FollowAxisController does, and writes the effort (N.m or N) that the chain
// of the axes needs for that motion. Geometry, masses, armature and damping are those of the axes'
// types; friction is left out. It starts where each target is at its demand, and both nearly stand.
// While it is not Active the effort is the safe value of the demand, which is 0. An effort beyond
// effort.max of a demand is limited by the framework, which is an event. Setup throws Error for a
// chain without a mass. In the tick, allocation-free.
class InverseDynamics final : public FollowAxisController {
public:
    using FollowAxisController::FollowAxisController;

private:
    struct Joint {
        std::string targetPath, demandPath;
        Data<const double> targetPosition, targetVelocity;
        Data<const double> acceptedPosition, acceptedVelocity;
        AxisOutput demand;

        double away() const CORTEX_REALTIME;  // the target, from the demand
        bool isThere() const CORTEX_REALTIME;
    };

    void populate() override;
    bool stateStartingUp(const Tick& tick) CORTEX_REALTIME override;
    void loopEnd(const Tick& tick) CORTEX_REALTIME override;
    void settingsProposed(ProposedSettings& proposed) CORTEX_REALTIME override;
    void settingsChanged() CORTEX_REALTIME override;
    void keep(Archive& archive) CORTEX_REALTIME override;

    void findJoints();
    void tellWaiting(const Joint& joint) CORTEX_REALTIME;
    void writeEfforts() CORTEX_REALTIME;

    std::optional<mechanics::InverseDynamics> dynamics_;
    std::vector<Joint> joints_;
    SerialChain::JointVector positions_, velocities_, accelerations_, none_;
    Data<const std::int64_t> part_;
    Data<const double> loadMass_;
    std::span<const double> loadCentre_, loadInertia_;
    double waited_ = 0;  // s
};

}  // namespace cortex::toolkit
