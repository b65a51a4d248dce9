// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/archive.hpp"
#include "cortex/cs/simplex_cs.hpp"

#include "process/number_range.hpp"
#include "process/scalar_output.hpp"

#include <string>

namespace cortex::toolkit {

// Leads a number to a target at a steady rate, on command; otherwise it keeps what stands.
class Ramp final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override;
    bool stateStartingUp(const Tick& tick) override;
    void stateActive(const Tick& tick) override;
    void keep(Archive& archive) override;

    Outcome goTo(Call& call) CORTEX_REALTIME;
    bool mayGoTo(Call& call, double target) const CORTEX_REALTIME;

    Argument<double> newTarget_;
    Data<const double> rate_;
    Data<double> target_, remaining_, progress_;
    ScalarOutput result_;
    std::string path_, item_;  // of what it writes
    NumberRange range_;
    double from_ = 0;  // where the command began
    bool begins_ = true;
};

}  // namespace cortex::toolkit
