// SPDX-License-Identifier: Apache-2.0
#include "common/image_items.hpp"

namespace cortex::common {

std::optional<State> stateOf(const comms::AgentImage& image, std::uint32_t simplex) {
    if (!image || !image.came(simplex)) return std::nullopt;
    if (image->structure().simplexes[simplex].role != Role::Active) return std::nullopt;
    const auto number = itemOf<std::int64_t>(*image, simplex, "state");
    if (!number || *number < 0 || *number >= stateCount) return std::nullopt;
    return static_cast<State>(*number);
}

}  // namespace cortex::common
