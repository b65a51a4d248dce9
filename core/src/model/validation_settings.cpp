// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/system_findings.hpp"
#include "cortex/core/text_faults.hpp"

#include "base/text.hpp"
#include "model/remedies.hpp"
#include "model/validation_checks.hpp"
#include "tables/lookup.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cortex {
namespace {

using Setting = Simplex::Setting;

// Types of base.xml whose items the framework writes.
constexpr std::array frameworkTypes{"Active", "Activity", "Agent", "Cluster"};

bool isFramework(const TypeModel& types, const Type& type, const DataItem& item) {
    return std::ranges::any_of(frameworkTypes, [&](const char* name) {
        const Type* base = types.find(name);
        return base != nullptr && type.isA(name) && base->findData(item.name) != nullptr;
    });
}

// Why a system file gives it no value; "" if it may.
std::string notGiven(const TypeModel& types, const Type& type, const DataItem& item) {
    if (isFramework(types, type, item)) return "is written by the framework";
    return item.measured ? "is measured: its simplex writes it, so no file gives it a value" : "";
}

long double exact(const Number& number) {
    return std::visit([](auto value) { return static_cast<long double>(value); }, number);
}

bool inRange(const DataItem& item, const Number& value) {
    return !(item.min && exact(value) < exact(*item.min)) &&
           !(item.max && exact(value) > exact(*item.max));
}

template <class T>
T moved(const DataItem& item, T value) {
    const Number& bound = item.min && exact(value) < exact(*item.min) ? *item.min : *item.max;
    return std::visit([](auto number) { return static_cast<T>(number); }, bound);
}

// Without a range the labels are all there is.
bool isLabel(const DataItem& item, std::int64_t value) {
    return item.labels.empty() || item.min || item.max || item.labels.contains(value);
}

std::string labelText(const DataItem& item) {
    std::string text;
    for (const auto& [number, label] : item.labels) {
        text += (text.empty() ? "" : " ") + toText(number) + ":" + label;
    }
    return text;
}

std::string rangeText(const DataItem& item) {
    const std::string unit = item.unit.empty() ? "" : " " + item.unit;
    if (item.min && item.max) {
        return "is from " + toText(*item.min) + " to " + toText(*item.max) + unit;
    }
    return item.min ? "is at least " + toText(*item.min) + unit
                    : "is at most " + toText(*item.max) + unit;
}

// One setting with its item and the words that its findings have in common.
struct Case {
    const Checked& checked;
    const Simplex& simplex;
    const Setting& setting;
    const DataItem& item;

    void error(const char* rule, const std::string& message, const Value& mended) const {
        checked.report.error(simplex.path(), rule, setting.place,
                             "item '" + item.name + "' (" + item.place.text() + ") " + message,
                             "write " + setText(item.name, valueText(mended)));
    }
};

void checkFloats(const Case& each, std::vector<double> values) {
    const Value written{values};
    bool finite = true;
    for (double& value : values) {
        if (std::isfinite(value)) continue;
        finite = false;
        value = 0;
    }
    if (!finite) {
        each.error(finding::settingFinite, "is a finite number, set is " + toText(written),
                   each.item.initial);
        return;
    }
    bool good = true;
    for (double& value : values) {
        if (inRange(each.item, value)) continue;
        good = false;
        value = moved(each.item, value);
    }
    if (good) return;
    each.error(finding::settingRange, rangeText(each.item) + ", set is " + toText(written), values);
}

void checkInts(const Case& each, std::vector<std::int64_t> values) {
    const Value written{values};
    bool labelled = true, good = true;
    for (std::int64_t& value : values) {
        labelled = labelled && isLabel(each.item, value);
        if (inRange(each.item, value)) continue;
        good = false;
        value = moved(each.item, value);
    }
    if (!labelled) {
        each.error(finding::settingRange,
                   "is one of " + labelText(each.item) + ", set is " + toText(written),
                   std::vector(values.size(), each.item.labels.begin()->first));
    } else if (!good) {
        each.error(finding::settingRange, rangeText(each.item) + ", set is " + toText(written),
                   values);
    }
}

void checkStrings(const Case& each, std::vector<std::string> values) {
    for (const std::string& value : values) {
        const char* fault = textFault(value);
        if (fault == nullptr) continue;
        each.error(finding::settingKind, std::string{"is set to a text that "} + fault,
                   each.item.initial);
        return;
    }
    const auto longest = std::ranges::max_element(values, {}, &std::string::size);
    if (longest == values.end() || longest->size() <= each.item.capacity) return;
    const std::size_t size = longest->size();
    for (std::string& value : values) {
        std::size_t cut = std::min<std::size_t>(value.size(), each.item.capacity);
        while (cut > 0 && cut < value.size() && (value[cut] & 0xC0) == 0x80) --cut;
        value.resize(cut);
    }
    each.error(
        finding::settingLength,
        "takes " + std::to_string(each.item.capacity) + " octets, set are " + std::to_string(size),
        values);
}

void checkValue(const Case& each) {
    const Value& value = each.setting.value;
    if (kindOf(value) != each.item.kind) {
        each.error(
            finding::settingKind,
            std::string{"is a "} + name(each.item.kind) + ", set is a " + name(kindOf(value)),
            each.item.initial);
    } else if (lengthOf(value) != each.item.length) {
        each.error(
            finding::settingLength,
            "is " + shapeOf(each.item) + ": " + wrongCount(each.item.length, lengthOf(value)),
            each.item.initial);
    } else if (const auto* floats = std::get_if<std::vector<double>>(&value)) {
        checkFloats(each, *floats);
    } else if (const auto* ints = std::get_if<std::vector<std::int64_t>>(&value)) {
        checkInts(each, *ints);
    } else if (const auto* strings = std::get_if<std::vector<std::string>>(&value)) {
        checkStrings(each, *strings);
    }
}

}  // namespace

void reportUnknownItem(const TypeModel& types, const Simplex& simplex, const Setting& setting,
                       Report& report) {
    std::vector<std::string> names;
    for (const DataItem& item : simplex.type().data) {
        if (notGiven(types, simplex.type(), item).empty()) names.push_back(item.name);
    }
    std::string nearest;
    if (looksForNearest(report)) nearest = nearestName(setting.item, names);
    std::string remedy = names.empty() ? "remove this <set>: there is nothing to set"
                                       : "items that can be set: " + listText(names);
    if (!nearest.empty()) {
        remedy = "write " + setText(nearest, valueText(setting.value)) + "; " + remedy;
    }
    report.error(simplex.path(), finding::unknownItem, setting.place,
                 "type " + simplex.type().name + " has no item '" + setting.item + "'", remedy);
}

void checkSettings(const Checked& checked, const Simplex& simplex) {
    for (const Setting& setting : simplex.settings()) {
        const DataItem* item = simplex.type().findData(setting.item);
        if (item == nullptr) {
            reportUnknownItem(checked.tree.types(), simplex, setting, checked.report);
            continue;
        }
        const std::string why = notGiven(checked.tree.types(), simplex.type(), *item);
        if (why.empty()) {
            checkValue({checked, simplex, setting, *item});
        } else {
            checked.report.error(simplex.path(), finding::settingFramework, setting.place,
                                 "item '" + item->name + "' (" + item->place.text() + ") " + why,
                                 "remove this <set>");
        }
    }
}

}  // namespace cortex
