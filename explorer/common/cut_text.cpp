// SPDX-License-Identifier: Apache-2.0
#include "common/cut_text.hpp"

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

namespace cortex::common {

bool fills(std::string_view text, std::size_t capacity) {
    constexpr std::size_t mostFree = 3;
    if (text.size() >= capacity) return true;
    const bool ascii = std::ranges::none_of(text, [](char c) { return (c & 0x80) != 0; });
    return !ascii && text.size() + mostFree >= capacity;
}

bool mayBeCut(const DataItem& item, const Value& value, std::size_t element) {
    if (item.constant || !item.settable.empty()) return false;
    const auto* texts = std::get_if<std::vector<std::string>>(&value);
    if (texts == nullptr || element >= texts->size()) return false;
    return fills((*texts)[element], item.capacity);
}

}  // namespace cortex::common
