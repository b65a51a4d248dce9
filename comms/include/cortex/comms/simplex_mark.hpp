// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/quality.hpp"
#include "cortex/core/state.hpp"

#include <optional>

namespace cortex::comms {

// How a simplex is, without its values.
struct SimplexMark {
    std::optional<State> state;       // of its newest cycle that came; none: it has none
    Quality quality = Quality::Lost;  // at least stale where nothing has come for a while
    bool outside = false;             // a good value of it is outside its limits

    bool fault() const { return state == State::Fault; }
    bool operator==(const SimplexMark&) const = default;
};

}  // namespace cortex::comms
