// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/simplex_cs.hpp"

#include "handles.hpp"

#include <string>
#include <vector>

namespace cortex::toolkit {

// A clutch: while enabled, the target is where the tip was plus the hand's displacement since. It
// lets go of the hand where the tip does not come along, so that no arm rushes after it later.
class CartesianFollowController final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    struct Axis {
        std::string path;
        Data<const std::int64_t> status;
    };

    void populate() override;
    bool stateStartingUp(const Tick& tick) override;
    void stateActive(const Tick& tick) override;
    bool stateShuttingDown(const Tick& tick) override;
    void keep(Archive& archive) override;
    void engage(bool engage);
    void followHand();
    void stayNear(const Pose& tip);
    EventText tooFar(double distance, double angle) const;
    void letGo(const EventText& why);
    const Axis* firstStanding() const;

    PoseInput hand_, tip_;
    PoseOutput target_;
    Enable enable_;
    Data<const double> greatestDistance_, greatestAngle_;
    Data<bool> engaged_;
    Data<std::int64_t> engageCount_, letGoCount_;
    Pose handThen_, tipThen_, pose_;
    std::string handPath_;
    std::vector<Axis> axes_;  // that move the tip, where it knows them
};

}  // namespace cortex::toolkit
