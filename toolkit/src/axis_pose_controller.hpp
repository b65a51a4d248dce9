// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/simplex_cs.hpp"

#include "handles.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace cortex::toolkit {

// Brings the axes to a pose on command, all arriving at once.
class AxisPoseController final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    struct Axis {
        AxisInput observed;
        AxisOutput demand;
        AxisLimits limits;
        double from = 0, way = 0, position = 0;

        void keep(Archive& archive) { archive & from & way & position; }
    };

    void populate() override;
    bool stateStartingUp(const Tick& tick) override;
    void stateActive(const Tick& tick) override;
    void keep(Archive& archive) override;
    Outcome moveTo(Call& call);
    bool poseIsInRange() const;
    void begin(double speedShare);

    std::vector<Axis> axes_;
    std::span<const double> pose_;
    Data<double> progress_;
    Argument<double> speedShare_;
    double duration_ = 0, time_ = 0;  // s, of the move
};

}  // namespace cortex::toolkit
