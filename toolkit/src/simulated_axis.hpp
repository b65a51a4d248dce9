// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/simplex_cs.hpp"

#include "handles.hpp"

#include <optional>

namespace cortex::toolkit {

// A drive and its joint: second order, with the limits of its axis; braked unless Active.
class SimulatedAxis final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    enum Status : std::int64_t { Ready = 1, Moving, AtLimit, Faulty, Braked = 7 };

    void populate() override;
    bool stateStartingUp(const Tick& tick) override;
    void loopEnd(const Tick& tick) override;
    void keep(Archive& archive) override;

    double startOf(const OutputSimplex& observation);
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
    double waited_ = 0;  // s, in StartingUp
    bool atLimit_ = false;
};

}  // namespace cortex::toolkit
