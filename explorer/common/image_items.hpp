// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

// Single items of a simplex, by their names, as both programs need them.
namespace cortex::common {

// The first element of a value; none: it has none, or they are of another kind.
template <class T>
std::optional<T> firstOf(const Value& value) {
    const auto* all = std::get_if<std::vector<T>>(&value);
    return all == nullptr || all->empty() ? std::nullopt : std::optional<T>{all->front()};
}

// The first element of an item of the image; none: there is no such item of this kind.
template <class T>
std::optional<T> itemOf(const Image& image, std::uint32_t simplex, std::string_view item) {
    const ItemLayout* layout = image.structure().simplexes[simplex].layout->find(item);
    return layout == nullptr ? std::nullopt : firstOf<T>(image.value(simplex, *layout));
}

// The state of an active simplex as it came last; none for others, and while it has not come.
std::optional<State> stateOf(const comms::AgentImage& image, std::uint32_t simplex);

}  // namespace cortex::common
