// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/archive.hpp"
#include "cortex/cs/simplex_cs.hpp"

namespace cortex::toolkit {

// Keeps a measured number at its set-point: u = kp·e + integral + derivative of what is measured
// (docs/process.md). It begins at the output that stands. Derive to add what is known of the plant.
class PidController : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

protected:
    // Each calls that of the base first.
    void populate() override;
    bool stateStartingUp(const Tick& tick) CORTEX_REALTIME override;
    void stateActive(const Tick& tick) CORTEX_REALTIME override;
    void settingsProposed(ProposedSettings& proposed) CORTEX_REALTIME override;
    void keep(Archive& archive) CORTEX_REALTIME override;

    // Output that is added to that of the three terms, in the unit of the output.
    virtual double feedForward(const Tick&) CORTEX_REALTIME { return 0; }

    double setpoint() const CORTEX_REALTIME { return setpoint_; }
    double measured() const CORTEX_REALTIME { return measured_; }

private:
    double trackingTime() const CORTEX_REALTIME;
    void begin(double error, double added) CORTEX_REALTIME;

    Data<const double> measured_, setpoint_, accepted_;
    Data<const double> kp_, ki_, kd_, filterTime_, trackingTime_, outputMin_, outputMax_;
    Data<double> output_, error_, integral_;
    double least_ = 0, greatest_ = 0;  // of the demand
    double wanted_ = 0;                // in the cycle before, without limits
    double lastMeasured_ = 0, derivative_ = 0, gain_ = 0;
    bool begins_ = true;
};

}  // namespace cortex::toolkit
