// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/labelled_value.hpp"

#include "cortex/core/nearest_names.hpp"

#include <algorithm>
#include <sstream>
#include <type_traits>

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

template <class T>
std::string elementOutside(const DataItem& item, const T& element) {
    if constexpr (std::is_same_v<T, std::int64_t> || std::is_same_v<T, double>) {
        const Number number{element};
        if (item.min && number < *item.min) return "below " + toText(*item.min);
        if (item.max && *item.max < number) return "above " + toText(*item.max);
        if constexpr (std::is_same_v<T, std::int64_t>) {
            if (isClosed(item) && !item.labels.contains(element)) return "none of its labels";
        }
    }
    return {};
}

}  // namespace

bool isClosed(const DataItem& item) { return !item.labels.empty() && !item.min && !item.max; }

std::string outsideText(const DataItem& item, const Value& value) {
    return std::visit(
        [&item](const auto& elements) {
            using Element = typename std::decay_t<decltype(elements)>::value_type;
            for (const auto& element : elements) {
                std::string text = elementOutside<Element>(item, element);
                if (!text.empty()) return text;
            }
            return std::string{};
        },
        value);
}

std::optional<Value> parseItemValue(const DataItem& item, std::string_view text, std::string& why) {
    if (item.labels.empty()) return parseValue(item.kind, item.length, text, why);
    auto value = parseValue(item.kind, item.length, withNumbers(item, text), why);
    if (value) return value;
    const std::string nearest = withNearestLabels(item, text);
    if (item.length == 1) why = "no label '" + std::string{text} + "'";
    if (!nearest.empty()) why += "; nearest of: " + nearest;
    why += "; labels:";
    for (const auto& [number, label] : item.labels) why += " " + toText(number) + ":" + label;
    return value;
}

std::string withNearestLabels(const DataItem& item, std::string_view text) {
    std::vector<std::string> labels;
    for (const auto& [number, label] : item.labels) labels.push_back(label);
    std::istringstream words{std::string{text}};
    std::string result;
    std::size_t count = 0;
    for (std::string word; words >> word; ++count) {
        const bool right = toInt(word) || std::ranges::find(labels, word) != labels.end();
        const std::string meant = right ? word : nearestName(word, labels);
        if (meant.empty()) return {};
        result += (result.empty() ? "" : " ") + meant;
    }
    return count == item.length ? result : "";
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
