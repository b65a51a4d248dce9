// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/simplex_cs.hpp"

#include "handles.hpp"

#include <cstdint>
#include <optional>

namespace cortex::toolkit {

// Moves one axis back and forth.
class SineController final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override;
    bool stateStartingUp(const Tick& tick) override;
    void stateActive(const Tick& tick) override;
    void keep(Archive& archive) override;

    std::optional<AxisOutput> axis_;
    Data<const double> amplitude_, frequency_;
    std::int64_t startedAt_ = 0;
};

}  // namespace cortex::toolkit
