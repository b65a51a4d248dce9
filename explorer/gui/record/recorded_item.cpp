// SPDX-License-Identifier: Apache-2.0
#include "record/recorded_item.hpp"

#include "cortex/core/value.hpp"

namespace cortex::gui {

std::optional<RecordedItem> recordedItem(std::string_view text) {
    RecordedItem result;
    if (text.ends_with(']')) {
        const auto open = text.rfind('[');
        if (open == std::string_view::npos) return std::nullopt;
        const auto element = toInt(text.substr(open + 1, text.size() - open - 2));
        if (!element || *element < 0) return std::nullopt;
        result.element = static_cast<std::size_t>(*element);
        text = text.substr(0, open);
    }
    const auto dot = text.rfind('.');
    if (!text.starts_with('/') || dot == std::string_view::npos) return std::nullopt;
    result.path = text.substr(0, dot);
    result.item = text.substr(dot + 1);
    if (result.path.size() < 2 || result.item.empty()) return std::nullopt;
    return result;
}

std::string textOf(const RecordedItem& item) {
    std::string text = item.path + '.' + item.item;
    if (item.element > 0) text += '[' + std::to_string(item.element) + ']';
    return text;
}

}  // namespace cortex::gui
