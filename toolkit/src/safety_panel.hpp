// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/simplex_cs.hpp"

namespace cortex::toolkit {

// An emergency stop button for tests and examples. It tells in every state of its own.
class SimulatedSafetyPanel final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override;
    void loopEnd(const Tick& tick) CORTEX_REALTIME override;
    void keep(Archive& archive) CORTEX_REALTIME override;

    Outcome press(Call& call) CORTEX_REALTIME;
    Outcome release(Call& call) CORTEX_REALTIME;
    Outcome reset(Call& call) CORTEX_REALTIME;

    Data<bool> emergencyStop_, resetNeeded_;
    bool pressed_ = false, stopped_ = false;
};

}  // namespace cortex::toolkit
