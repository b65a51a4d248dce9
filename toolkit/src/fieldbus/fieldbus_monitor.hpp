// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/simplex_cs.hpp"

#include <cstdint>
#include <vector>

namespace cortex::toolkit {

// Counts the links of several devices that are open, refused and lost.
class FieldbusMonitor final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    struct Device {
        const SlotState* state;
        Data<const std::int64_t> link;
        Data<const double> age;
    };
    void populate() override;
    void loopEnd(const Tick& tick) CORTEX_REALTIME override;

    std::vector<Device> devices_;
    Data<std::int64_t> open_, refused_, lost_;
    Data<double> worstAge_;
};

}  // namespace cortex::toolkit
