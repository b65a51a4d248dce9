// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/labelled_value.hpp"

#include <sstream>

namespace cortex {
namespace {

std::string withNumbers(const DataItem& item, std::string_view text) {
    std::istringstream words{std::string{text}};
    std::string result;
    for (std::string word; words >> word;) {
        for (const auto& [number, label] : item.labels) {
            if (label != word) continue;
            word = toText(number);
            break;
        }
        result += (result.empty() ? "" : " ") + word;
    }
    return result;
}

}  // namespace

std::optional<Value> parseItemValue(const DataItem& item, std::string_view text, std::string& why) {
    if (item.labels.empty()) return parseValue(item.kind, item.length, text, why);
    auto value = parseValue(item.kind, item.length, withNumbers(item, text), why);
    if (value) return value;
    why += "; labels:";
    for (const auto& [number, label] : item.labels) why += " " + toText(number) + ":" + label;
    return value;
}

std::vector<std::string> labelsOf(const DataItem& item, const Value& value) {
    std::vector<std::string> labels;
    const auto* numbers = std::get_if<std::vector<std::int64_t>>(&value);
    if (numbers == nullptr || item.labels.empty()) return labels;
    for (const std::int64_t each : *numbers) {
        const auto found = item.labels.find(each);
        labels.push_back(found != item.labels.end() ? found->second : "");
    }
    return labels;
}

}  // namespace cortex
