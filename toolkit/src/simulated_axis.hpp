// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/simplex_cs.hpp"

#include "ds402/axis_targets.hpp"
#include "handles.hpp"

#include <optional>

namespace cortex::toolkit {

// A drive and its joint: second order, with the limits of its axis; braked unless Active. It stops
// when its demand is lost, and stands until that rests at the joint.
class SimulatedAxis final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    enum Status : std::int64_t { Ready = 1, Moving, AtLimit, Faulty, Braked = 7 };

    void populate() override;
    void loopStart(const Tick& tick) override;
    bool stateStartingUp(const Tick& tick) override;
    void loopEnd(const Tick& tick) override;
    void keep(Archive& archive) override;

    double startOf(const OutputSimplex& observation);
    AxisTarget demand() const;
    bool waitsForDemand(double seconds);
    void chooseTarget(double seconds);
    bool obeys() const;
    void servo(double seconds);
    void brake(double seconds);
    void limit(double before, double seconds);
    std::int64_t status() const;

    std::optional<AxisInput> demand_;
    std::optional<AxisOutput> observation_;
    Data<std::int64_t> observedStatus_;
    std::optional<AxisLimits> limits_;
    Data<const double> naturalFrequency_, dampingRatio_;
    Data<double> followingError_;
    Data<std::int64_t> limitCount_;
    double position_ = 0, velocity_ = 0;
    AxisTargets targets_;          // that it acts on
    mechanics::MotionState stop_;  // where it stops in place of that, since its demand is lost
    bool stops_ = false;
    double waited_ = 0;  // s, for its demand
    bool atLimit_ = false;
};

}  // namespace cortex::toolkit
