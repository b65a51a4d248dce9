// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/simplex_cs.hpp"

#include "process/scalar_output.hpp"

namespace cortex::toolkit {

// Passes a number on, no faster than its rate allows. It goes on from what went out before.
class RateLimiter final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override;
    void stateActive(const Tick& tick) override;

    Data<const double> source_, rate_;
    Data<bool> limiting_;
    ScalarOutput result_;
};

}  // namespace cortex::toolkit
