// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/image_items.hpp"
#include "session/frame.hpp"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace cortex::gui {

// The first element of an item, as it came last; none: it never came, or there is no such item of
// this kind.
template <class T>
std::optional<T> itemOf(const AgentFrame& agent, std::uint32_t simplex, std::string_view item) {
    const ItemLayout* layout = agent.structure->simplexes[simplex].layout->find(item);
    if (layout == nullptr) return std::nullopt;
    const auto value = agent.value(simplex, *layout);
    return value ? common::firstOf<T>(*value) : std::nullopt;
}

}  // namespace cortex::gui
