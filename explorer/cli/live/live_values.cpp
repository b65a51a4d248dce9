// SPDX-License-Identifier: Apache-2.0
#include "live/live_values.hpp"

#include "cortex/core/labelled_value.hpp"
#include "cortex/core/nearest_names.hpp"

#include "common/csv_cell.hpp"
#include "common/number_text.hpp"

#include <algorithm>

#include <unistd.h>

namespace cortex::cli {
namespace {

std::string exactNumber(const DataItem& item, double number) {
    return item.format.empty() ? toText(number) : common::numberText(item, number);
}

std::string labelText(const DataItem& item, std::int64_t number) {
    const auto label = item.labels.find(number);
    return label != item.labels.end() ? label->second : toText(number);
}

std::string textOf(const DataItem& item, const Value& value,
                   std::string (*numberText)(const DataItem&, double)) {
    std::vector<std::string> words;
    if (const auto* floats = std::get_if<std::vector<double>>(&value)) {
        for (const double each : *floats) words.push_back(numberText(item, each));
    } else if (const auto* ints = std::get_if<std::vector<std::int64_t>>(&value)) {
        for (const std::int64_t each : *ints) words.push_back(labelText(item, each));
    } else {
        return toText(value);
    }
    return joined(words, " ");
}

// What of a value can be refused before the agent is asked; "" if nothing.
std::string wrongArgument(const DataItem& item, const Value& value) {
    if (const auto* texts = std::get_if<std::vector<std::string>>(&value)) {
        for (const std::string& each : *texts) {
            if (each.size() > item.capacity)
                return "takes " + std::to_string(item.capacity) + " bytes, and " +
                       std::to_string(each.size()) + " are given";
        }
    }
    const auto* numbers = std::get_if<std::vector<std::int64_t>>(&value);
    if (numbers == nullptr || item.labels.empty() || !isClosed(item)) return {};
    const auto isLabel = [&](std::int64_t each) { return item.labels.contains(each); };
    const auto wrong = std::ranges::find_if_not(*numbers, isLabel);
    if (wrong == numbers->end()) return {};
    std::string labels;
    for (const auto& [number, label] : item.labels) {
        labels.append(" ").append(toText(number)).append(":").append(label);
    }
    return toText(*wrong) + " has no label; labels:" + labels;
}

}  // namespace

Json valueJson(const DataItem& item, const Value& value) {
    Json list = std::visit([](const auto& elements) { return Json(elements); }, value);
    return item.length == 1 && list.size() == 1 ? Json(list.front()) : list;
}

Json labelJson(const DataItem& item, const Value& value) {
    const std::vector<std::string> labels = labelsOf(item, value);
    if (labels.empty()) return {};
    return item.length == 1 ? Json(labels.front()) : Json(labels);
}

Json numberJson(const std::optional<Number>& number) {
    if (!number) return {};
    return std::visit([](auto value) { return Json(value); }, *number);
}

std::string valueText(const DataItem& item, const Value& value) {
    return textOf(item, value, common::numberText);
}

std::string exactText(const DataItem& item, const Value& value) {
    return textOf(item, value, exactNumber);
}

std::string plainText(const DataItem& item, const Value& value) {
    return item.labels.empty() ? exactText(item, value) : toText(value);
}

std::string wrongText(const DataItem& item, const Value& value) {
    const std::string wrong = outsideText(item, value);
    return wrong.empty() ? "" : "  <- " + wrong;
}

bool isLive(const comms::AgentImage& image, std::uint32_t simplex) {
    return image.came(simplex) && !image.lost();
}

ProgramInterface::Arguments parseArguments(const std::string& what, const RecordLayout& request,
                                           const std::vector<std::string>& texts) {
    std::vector<std::string> valid;
    for (const ItemLayout& each : request.items) valid.push_back(each.item->name);
    ProgramInterface::Arguments arguments;
    for (const std::string& text : texts) {
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos) {
            throw Failure{Usage, "'" + text + "': write it as name=value"};
        }
        const std::string name = text.substr(0, equals);
        const ItemLayout* item = request.find(name);
        if (item == nullptr) {
            const std::string nearest = nearestNames(name, valid);
            const std::string all = valid.empty() ? "there is none" : "there are " + joined(valid);
            throw Failure{Usage,
                          what + " has no '" + name + "'; " + (nearest.empty() ? all : nearest)};
        }
        std::string why;
        auto value = parseItemValue(*item->item, text.substr(equals + 1), why);
        if (value) why = wrongArgument(*item->item, *value);
        if (!why.empty()) throw Failure{Usage, name + ": " + why};
        if (!arguments.emplace(name, std::move(*value)).second) {
            throw Failure{Usage, "'" + name + "' is given twice"};
        }
    }
    return arguments;
}

std::string csvText(const std::string& text) {
    static const bool terminal = isatty(STDOUT_FILENO) == 1;
    return common::csvCell(terminal ? printable(text) : text);
}

}  // namespace cortex::cli
