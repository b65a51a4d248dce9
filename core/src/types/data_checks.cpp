// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/data.hpp"
#include "cortex/core/findings.hpp"
#include "cortex/core/labelled_value.hpp"
#include "cortex/core/text_faults.hpp"

#include "base/bounds.hpp"
#include "base/text.hpp"
#include "types/type_merge.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace cortex {

namespace {

bool numeric(Kind kind) { return kind == Kind::Int || kind == Kind::Float; }

std::string rangeText(const DataItem& item) {
    const auto text = [](const std::optional<Number>& bound) {
        return bound ? toText(*bound) : "*";
    };
    return text(item.min) + " to " + text(item.max);
}

void fitBound(std::optional<Number>& bound, const char* attribute, Kind kind,
              const ItemContext& context) {
    if (!bound) return;
    const double* real = std::get_if<double>(&*bound);
    if (!numeric(kind)) {
        context.error(finding::rangeKind,
                      std::string{"has "} + attribute + ", but " + name(kind) + " has no range",
                      std::string{"remove "} + attribute);
        bound.reset();
    } else if (real && (kind == Kind::Int || !std::isfinite(*real))) {
        context.error(finding::rangeKind,
                      std::string{"has "} + attribute + "=" + inQuotes(toText(*bound)) +
                          ", which is not " + (kind == Kind::Int ? "a whole number" : "finite"),
                      kind == Kind::Int ? "write a whole number of 64 bit" : "leave it out");
        bound.reset();
    } else if (!real && kind == Kind::Float) {
        bound = static_cast<double>(std::get<std::int64_t>(*bound));
    } else if (real && *real == 0) {
        bound = 0.0;  // "-0" would be read again as a whole number, which has no such zero
    }
}

// Text from XML, whole numbers for a float: as the item's kind and length. "" or what is wrong.
std::string fitValue(Value& value, const DataItem& shape) {
    const auto* strings = std::get_if<std::vector<std::string>>(&value);
    const bool raw = strings && (shape.kind != Kind::String || strings->size() != shape.length);
    if (raw && strings->size() == 1) {
        std::string why;
        const auto parsed = parseValue(shape.kind, shape.length, strings->front(), why);
        if (!parsed) return why;
        value = *parsed;
        return {};
    }
    const auto* whole = std::get_if<std::vector<std::int64_t>>(&value);
    if (whole && shape.kind == Kind::Float)
        value = std::vector<double>(whole->begin(), whole->end());
    if (kindOf(value) != shape.kind) {
        return std::string{"expected "} + name(shape.kind) + ", found " + name(kindOf(value));
    }
    if (lengthOf(value) != shape.length) return wrongCount(shape.length, lengthOf(value));
    return {};
}

template <class T>
std::string elementError(const DataItem& item, const T& element) {
    if constexpr (std::is_same_v<T, std::string>) {
        if (element.size() > item.capacity) {
            return "is longer than the capacity of " + std::to_string(item.capacity) + " octets";
        }
        const char* fault = textFault(element);
        return fault == nullptr ? "" : fault;
    } else if constexpr (std::is_same_v<T, std::int64_t> || std::is_same_v<T, double>) {
        const Number number{element};
        if constexpr (std::is_same_v<T, double>) {
            if (!std::isfinite(element)) return "is not finite";
        } else if (isClosed(item) && !item.labels.contains(element)) {
            return "is none of the labelled numbers";
        }
        const bool out = (item.min && number < *item.min) || (item.max && *item.max < number);
        return out ? "is out of the range " + rangeText(item) : "";
    } else {
        return "";
    }
}

// Zero, or what is nearest to it in the range; the first label's number where 0 has none.
template <class T>
T implicitNumber(const DataItem& item) {
    T number{};
    if (item.min) number = std::max(number, std::get<T>(*item.min));
    if (item.max) number = std::min(number, std::get<T>(*item.max));
    if constexpr (std::is_same_v<T, std::int64_t>) {
        if (isClosed(item) && !item.labels.contains(0)) number = item.labels.begin()->first;
    }
    return number;
}

void checkValues(DataItem& item, const DataItem* own, const ItemContext& context) {
    if (item.hasDefault) {
        const std::string error = valueError(item, item.initial);
        if (!error.empty()) {
            const bool restated = own && own->hasDefault;
            context.error(finding::defaultRange,
                          std::string{"has "} + (restated ? "" : "the inherited ") + "default " +
                              inQuotes(toText(item.initial)) + ", which " + error,
                          "write default=\"" + toText(implicitValue(item)) +
                              "\" or another that is in range");
            item.hasDefault = false;
        }
    }
    if (!item.hasDefault) item.initial = implicitValue(item);
    if (item.safe.kind != Safe::Kind::Given) return;
    std::string error = valueError(item, item.safe.value);
    const std::string text = toText(item.safe.value);
    if (item.kind == Kind::String && (text == "hold" || text == "observed" || text == "stop")) {
        error = "is a word of files for another thing";
    }
    if (error.empty()) return;
    context.error(
        finding::safeRange,
        "has the safe value " + inQuotes(toText(item.safe.value)) + ", which " + error,
        "write the value in that range that is safe for the plant, or hold, observed or stop");
    item.safe.value = implicitValue(item);
}

void checkSteps(DataItem& item, const ItemContext& context) {
    const auto step = [&](double& value, const char* attribute) {
        if (value == 0) return;
        if (numeric(item.kind) && std::isfinite(value) && value > 0) return;
        context.error(
            finding::resolution,
            std::string{"has "} + attribute + "=" + inQuotes(toText(value)) + " for " +
                name(item.kind),
            std::string{"write a number of 0 or more for int or float, or remove "} + attribute);
        value = 0;
    };
    step(item.resolution, "resolution");
    step(item.deadband, "deadband");
    if (item.rate && !(item.kind == Kind::Float && std::isfinite(*item.rate) && *item.rate > 0)) {
        context.error(finding::rate,
                      "has rate=" + inQuotes(toText(*item.rate)) + " for " + name(item.kind),
                      "write a number above 0, for float only");
        item.rate.reset();
    }
}

void checkLabels(DataItem& item, const DataItem* own, const ItemContext& context) {
    if (item.labels.empty()) return;
    if (item.kind != Kind::Int) {
        context.error(finding::labels, std::string{"has labels, but is "} + name(item.kind),
                      "write kind=\"int\", or remove the labels");
        item.labels.clear();
        return;
    }
    std::map<std::string_view, std::int64_t> numbers;
    for (const auto& [number, label] : item.labels) {
        if (label.empty() || label.find_first_of(" \t\r\n") != std::string::npos) {
            context.error(finding::labels,
                          "has the label " + inQuotes(label) + ", which is no word",
                          "write one without blanks, such as not-ready");
        } else if (toInt(label)) {
            context.error(finding::labels,
                          "has the label " + inQuotes(label) + ", which is a number, too",
                          "write a word, such as step-" + label);
        }
        const auto [known, added] = numbers.emplace(label, number);
        if (added) continue;
        context.error(finding::labels,
                      "gives the label " + inQuotes(label) + " to " +
                          std::to_string(known->second) + " and to " + std::to_string(number),
                      "give each number a label of its own");
    }
    if (!own) return;
    for (const auto& [number, label] : own->labels) {
        const Number asNumber{number};
        if ((!item.min || *item.min <= asNumber) && (!item.max || asNumber <= *item.max)) continue;
        context.error(
            finding::labels,
            "labels " + std::to_string(number) + ", which is out of the range " + rangeText(item),
            "widen the range or remove the label");
    }
}

void checkTexts(const DataItem& item, const ItemContext& context) {
    constexpr std::size_t longestFormat = 32;
    if (item.description.size() > bounds::textLength) {
        context.error(finding::textLength, "has a description of more than 4096 octets",
                      "shorten it");
    }
    if (item.format.size() > longestFormat) {
        context.error(finding::textLength, "has a format of more than 32 octets", "shorten it");
    }
}

// Another agent gets each attribute as one text.
void checkSent(const DataItem& item, const ItemContext& context) {
    const auto judge = [&](const char* what, std::size_t octets, const char* remedy) {
        if (octets <= bounds::sentText) return;
        context.error(finding::textLength,
                      std::string{"has "} + what + " of " + std::to_string(octets) +
                          " octets as text: other agents get at most 65536",
                      remedy);
    };
    constexpr std::uint32_t fewest = 8;  // elements: less are never as long
    constexpr const char* shorter =
        "leave out what is zero anyway, or write a shorter array, shorter texts or fewer digits";
    const bool isLong = item.length >= fewest;
    if (isLong && item.hasDefault) judge("a default", toText(item.initial).size(), shorter);
    if (isLong && item.safe.kind == Safe::Kind::Given) {
        judge("a safe value", toText(item.safe.value).size(), shorter);
    }
    std::size_t labels = 0;
    for (const auto& [number, label] : item.labels) {
        labels += (labels > 0 ? 1 : 0) + toText(number).size() + 1 + label.size();
    }
    judge("labels", labels, "shorten them");
    judge("a unit", item.unit.size(), "shorten it");
}

// A text whose blanks divide elements would come back as other elements.
void checkRetained(DataItem& item, const ItemContext& context) {
    if (!item.retain) return;
    const std::pair<bool, const char*> reasons[] = {
        {item.constant, "constant"},
        {item.measured, "measured"},
        {item.safe.kind != Safe::Kind::None, "a demand with a safe value"},
        {item.kind == Kind::String && item.length != 1, "an array of texts"}};
    for (const auto& [holds, what] : reasons) {
        if (!holds) continue;
        context.error(finding::retain, std::string{"is retained and "} + what,
                      "remove retain: a restart cannot bring this value back");
        item.retain = false;
    }
}

}  // namespace

std::string valueError(const DataItem& item, const Value& value) {
    return std::visit(
        [&item](const auto& elements) {
            using Element = typename std::decay_t<decltype(elements)>::value_type;
            for (const auto& element : elements) {
                std::string error = elementError<Element>(item, element);
                if (!error.empty()) return error;
            }
            return std::string{};
        },
        value);
}

Value implicitValue(const DataItem& item) {
    switch (item.kind) {
        case Kind::Int:
            return std::vector<std::int64_t>(item.length, implicitNumber<std::int64_t>(item));
        case Kind::Float:
            return std::vector<double>(item.length, implicitNumber<double>(item));
        case Kind::Bool:
            return std::vector<bool>(item.length, false);
        case Kind::String:
            break;
    }
    return std::vector<std::string>(item.length);
}

void checkShape(DataItem& own, const Stated& stated, const ItemContext& context) {
    if (own.length < 1 || own.length > bounds::arrayLength) {
        context.error(finding::lengthBounds, "has length=" + inQuotes(std::to_string(own.length)),
                      "write length=\"1\", or up to 65536");
        own.length = 1;
    }
    if (own.capacity < 1 || own.capacity > bounds::stringCapacity) {
        context.error(finding::capacityBounds,
                      "has capacity=" + inQuotes(std::to_string(own.capacity)),
                      "write capacity=\"64\", or from 1 to 4096 octets");
        own.capacity = DataItem{}.capacity;
    }
    if (own.kind != Kind::String &&
        stated.isWritten("capacity", own.capacity != DataItem{}.capacity)) {
        context.error(finding::capacityKind,
                      std::string{"has a capacity, but is "} + name(own.kind),
                      "remove the capacity, or write kind=\"string\"");
        own.capacity = DataItem{}.capacity;
    }
    if (!numeric(own.kind) && !own.unit.empty()) {
        context.error(finding::unitKind, std::string{"has a unit, but is "} + name(own.kind),
                      "remove the unit");
        own.unit.clear();
    }
}

void fitData(DataItem& own, const DataItem& shape, const ItemContext& context) {
    fitBound(own.min, "min", shape.kind, context);
    fitBound(own.max, "max", shape.kind, context);
    if (own.hasDefault) {
        const std::string error = fitValue(own.initial, shape);
        if (!error.empty()) {
            context.error(finding::defaultKind, "has a default that does not fit: " + error,
                          "write a default of the item's kind and length");
            own.hasDefault = false;
        }
    }
    if (own.safe.kind != Safe::Kind::Given) return;
    const std::string error = fitValue(own.safe.value, shape);
    if (error.empty()) return;
    context.error(finding::safeKind, "has a safe value that does not fit: " + error,
                  "write hold, observed, stop, or a value of the item's kind and length");
    own.safe = {Safe::Kind::Hold, {}};
}

void checkData(DataItem& item, const DataItem* own, const ItemContext& context) {
    if (item.min && item.max && *item.max < *item.min) {
        context.error(finding::rangeEmpty, "has the empty range " + rangeText(item),
                      "write max=\"" + toText(*item.min) + "\" or more, or a smaller min");
        item.max = item.min;
    }
    if (!item.settable.empty() && item.constant) {
        context.error(finding::settableConstant, "is settable and constant",
                      "remove one of the two: a constant item is set in the system file only");
        item.settable = StateSet::none();
    }
    checkRetained(item, context);
    checkSteps(item, context);
    checkLabels(item, own, context);
    checkValues(item, own, context);
    checkTexts(item, context);
    checkSent(item, context);
}

std::size_t recordSize(const std::vector<DataItem>& parameters) {
    std::size_t size = 0;
    for (const DataItem& item : parameters) {
        const std::size_t element = item.kind == Kind::String ? StringCell::size(item.capacity)
                                    : item.kind == Kind::Bool ? sizeof(bool)
                                                              : sizeof(double);
        size += (item.length * element + 7U) / 8U * 8U;
    }
    return size;
}

}  // namespace cortex
