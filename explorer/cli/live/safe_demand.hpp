// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "live/live.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace cortex::cli {

// What its writer's state says about a stale demand.
struct StaleDemand {
    bool safe = false;  // it is its safe value; otherwise a hook may have moved it
    std::string why;    // "/arm/control is in Fault"; empty: it is no such demand, or not known
};

// The writer that makes this simplex stale, if it is a demand.
std::optional<std::uint32_t> staleBy(const FoundSimplex& demand, const SlotState& state);
// `image`: of the same agent, with the values of that writer.
StaleDemand safeBecause(const FoundSimplex& demand, const SlotState& state,
                        const comms::AgentImage& image);
// "stale, safe", or the name of the quality.
std::string qualityText(Quality quality, const StaleDemand& demand);
Json safeJson(const StaleDemand& demand);  // why it is safe; null where it is not

}  // namespace cortex::cli
