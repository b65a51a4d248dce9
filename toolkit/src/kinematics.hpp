// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/simplex_cs.hpp"

#include "handles.hpp"

#include <optional>
#include <vector>

namespace cortex::toolkit {

// Tip of a serial chain from its axes; geometry from the axes. In the tick, allocation-free.
class ForwardKinematics final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override;
    void stateActive(const Tick& tick) override;

    std::optional<SerialChain> chain_;
    std::vector<AxisInput> axes_;
    PoseOutput tip_;
    SerialChain::JointVector positions_, velocities_;
    SerialChain::Jacobian jacobian_;
};

// Axes that bring the tip of a serial chain to a pose, from the last solution on. In the tick,
// allocation-free, no joint faster than its speed.
class InverseKinematics final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override;
    bool stateStartingUp(const Tick& tick) override;
    void stateActive(const Tick& tick) override;
    void keep(Archive& archive) override;
    void readObserved();
    bool jumps(const Pose& aim, double seconds) const;
    void seed();

    std::optional<SerialChain> chain_;
    std::vector<AxisInput> axes_;
    std::vector<AxisOutput> targets_;
    PoseInput target_;
    Data<const double> seedDistance_;
    Data<double> positionError_, rotationError_;
    Data<bool> reached_;
    Data<std::int64_t> seedCount_;
    SerialChain::JointVector observed_, solution_, posture_;
    Pose aimed_;  // the target of the cycle before
};

}  // namespace cortex::toolkit
