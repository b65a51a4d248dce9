// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/simplex_cs.hpp"

namespace cortex::profiler {

// Of the type Partner: answers a number with itself.
class Echo final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override {
        asked_ = argument<double>("ping", "number");
        answered_ = result<double>("ping", "number");
        on<&Echo::ping>("ping");
    }
    Outcome ping(Call& call) {
        call[answered_] = static_cast<double>(call[asked_]);
        return Outcome::Done;
    }

    Argument<double> asked_;
    Result<double> answered_;
};

}  // namespace cortex::profiler
