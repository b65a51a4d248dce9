// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace cortex::common {

// What its writer's state says about a stale demand.
struct StaleDemand {
    bool safe = false;  // it is its safe value; otherwise a hook may have moved it
    std::string why;    // "/arm/control is in Fault"; empty: it is no such demand, or not known
};

// The writer that makes this simplex stale, if it is a demand.
std::optional<std::uint32_t> staleBy(const SimplexInfo& demand, const SlotState& state);
// `image`: of the same agent, with the values of that writer. `demand`: its number in there.
StaleDemand safeBecause(std::uint32_t demand, const SlotState& state,
                        const comms::AgentImage& image);

// The same without words, for what is looked at in every cycle.
bool isSafe(std::uint32_t demand, const SlotState& state, const comms::AgentImage& image);

}  // namespace cortex::common
