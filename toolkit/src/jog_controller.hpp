// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/simplex_cs.hpp"

#include "handles.hpp"

#include <cstdint>
#include <vector>

namespace cortex::toolkit {

// Moves axes at commanded speeds for as long as the commands are repeated.
class JogController final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    struct Axis {
        AxisInput observed;
        AxisOutput demand;
        AxisLimits limits;
        double position = 0, velocity = 0;
        std::int64_t until = 0;  // ns

        void keep(Archive& archive) { archive & position & velocity & until; }
    };

    void populate() override;
    bool stateStartingUp(const Tick& tick) override;
    void stateActive(const Tick& tick) override;
    void keep(Archive& archive) override;
    Outcome jog(Call& call);

    std::vector<Axis> axes_;
    Data<const double> holdTime_;
    Data<bool> jogging_;
    Argument<std::int64_t> axis_;
    Argument<double> velocity_;
    std::int64_t now_ = 0;
};

}  // namespace cortex::toolkit
