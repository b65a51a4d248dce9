// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/simplex_cs.hpp"

#include "handles.hpp"

namespace cortex::toolkit {

// Compares what hand and tip have moved since the button was pressed, while a processor is Active.
class TrackingMonitor final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override;
    void stateActive(const Tick& tick) override;
    void keep(Archive& archive) override;
    void measure(double seconds);
    void publish();

    PoseInput hand_, tip_;
    Enable enable_;
    Data<const std::int64_t> processorState_;
    Data<const bool> engaged_;  // of the clutch, where it knows one
    Data<double> rmsPosition_, maxPosition_, rmsRotation_, maxRotation_, lag_, rmsSpeed_, time_;
    Data<std::int64_t> pressCount_;

    bool pressed_ = false;
    Pose handThen_, tipThen_;
    // Integrals over the measured time.
    double squaredDistance_ = 0, squaredAngle_ = 0, squaredSpeed_ = 0, behind_ = 0, measured_ = 0;
};

}  // namespace cortex::toolkit
