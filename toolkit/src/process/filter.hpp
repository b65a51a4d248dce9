// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/simplex_cs.hpp"

#include "process/scalar_output.hpp"

namespace cortex::toolkit {

// A low pass of the first order, exact for a source that keeps its value for a period.
class Filter final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override;
    bool stateStartingUp(const Tick& tick) override;
    void stateActive(const Tick& tick) override;

    Data<const double> source_, timeConstant_;
    ScalarOutput result_;
};

}  // namespace cortex::toolkit
