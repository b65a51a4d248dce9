// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/simplex_cs.hpp"

#include "handles.hpp"

namespace cortex::toolkit {

// A clutch: while enabled, the target is where the tip was plus the hand's displacement since.
class CartesianFollowController final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override;
    bool stateStartingUp(const Tick& tick) override;
    void stateActive(const Tick& tick) override;
    bool stateShuttingDown(const Tick& tick) override;
    void keep(Archive& archive) override;
    void engage(bool engage);

    PoseInput hand_, tip_;
    PoseOutput target_;
    Enable enable_;
    Data<bool> engaged_;
    Data<std::int64_t> engageCount_;
    Pose handThen_, tipThen_, pose_;
};

}  // namespace cortex::toolkit
