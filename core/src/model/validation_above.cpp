// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/labelled_value.hpp"
#include "cortex/core/system_findings.hpp"

#include "model/remedies.hpp"
#include "model/validation_checks.hpp"
#include "types/above_checks.hpp"

#include <algorithm>

namespace cortex {
namespace {

// What an item of a simplex holds: what is set, or the default of its type.
struct Holding {
    const DataItem& item;
    const Simplex::Setting* setting;

    const Value& value() const { return setting ? setting->value : item.initial; }
    // What is wrong by itself has a finding of its own.
    bool isGood() const {
        return kindOf(value()) == item.kind && lengthOf(value()) == item.length &&
               valueError(item, value()).empty();
    }
    std::string text() const { return quantityText(item, value()); }
    std::string origin() const {
        const std::string where = (setting ? setting->place : item.place).text();
        return (setting ? "set" : "by default") + (where.empty() ? "" : ", " + where);
    }
};

Holding holdingOf(const Simplex& simplex, const DataItem& item) {
    const auto& settings = simplex.settings();
    const auto found = std::ranges::find(settings, item.name, &Simplex::Setting::item);
    return {item, found != settings.end() ? &*found : nullptr};
}

Number numberOf(const Value& value) {
    if (const auto* whole = std::get_if<std::vector<std::int64_t>>(&value)) return whole->front();
    return std::get<std::vector<double>>(value).front();
}

// Each way that the ranges leave open.
std::string remedyOf(const Holding& upper, const Holding& lower) {
    const auto element = [](const Holding& which, const char* relation, const Holding& other) {
        return setText(which.item.name, "…") + " with a value " + relation + " " + other.text();
    };
    const auto& max = upper.item.max;
    const auto& min = lower.item.min;
    std::string ways;
    if (!max || *max > numberOf(lower.value())) ways = element(upper, "above", lower);
    if (!min || *min < numberOf(upper.value())) {
        ways += (ways.empty() ? "" : ", or ") + element(lower, "below", upper);
    }
    return ways.empty() ? "set both anew, or neither" : "write " + ways;
}

}  // namespace

// Of two defaults the type has the finding.
void checkAboveOther(const Checked& checked, const Simplex& simplex) {
    for (const DataItem& item : simplex.type().data) {
        const DataItem* other = boundBelow(simplex.type(), item);
        if (other == nullptr) continue;
        const Holding upper = holdingOf(simplex, item), lower = holdingOf(simplex, *other);
        const Simplex::Setting* setting = upper.setting ? upper.setting : lower.setting;
        if (setting == nullptr || !upper.isGood() || !lower.isGood()) continue;
        if (upper.value() > lower.value()) continue;
        checked.report.error(simplex.path(), finding::settingAbove, setting->place,
                             "item '" + item.name + "' is " + upper.text() + " (" + upper.origin() +
                                 "), which is not above item '" + other->name + "', " +
                                 lower.text() + " (" + lower.origin() + ")",
                             remedyOf(upper, lower));
    }
}

}  // namespace cortex
