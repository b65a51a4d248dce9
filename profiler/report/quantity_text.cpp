// SPDX-License-Identifier: Apache-2.0
#include "report/quantity_text.hpp"

#include "report/number_text.hpp"

#include <cmath>

namespace cortex::profiler {
namespace {

std::string withUnit(double value, const std::string& unit, std::string_view group) {
    const std::string text = readable(value, group);
    return unit.empty() || !std::isfinite(value) ? text : text + " " + unit;
}

}  // namespace

std::optional<double> ratioToBaseline(const Quantity& quantity) {
    if (!quantity.baseline) return {};
    const double ratio = quantity.value / *quantity.baseline;
    return std::isfinite(ratio) ? std::optional{ratio} : std::nullopt;
}

std::optional<bool> met(const Quantity& quantity) {
    switch (quantity.aim) {
        case Aim::AtMost:
            return quantity.value <= quantity.limit;
        case Aim::AtLeast:
            return quantity.value >= quantity.limit;
        case Aim::None:
            break;
    }
    return {};
}

Aims aimsOf(const Results& results) {
    Aims aims;
    for (const Quantity& each : results.quantities) {
        const std::optional<bool> found = met(each);
        if (!found) continue;
        ++aims.all;
        if (*found) continue;
        aims.missed.push_back(each.what + ": " + valueText(each) + " (aim " + aimText(each) + ")");
    }
    return aims;
}

std::string valueText(const Quantity& quantity, std::string_view group) {
    return withUnit(quantity.value, quantity.unit, group);
}

std::string baselineText(const Quantity& quantity, std::string_view group) {
    if (!quantity.baseline) return {};
    const std::string text = withUnit(*quantity.baseline, quantity.unit, group);
    return quantity.baselineName.empty() ? text : quantity.baselineName + ": " + text;
}

std::string ratioText(const Quantity& quantity) {
    const std::optional<double> ratio = ratioToBaseline(quantity);
    return ratio ? readable(*ratio) + "×" : "";
}

std::string aimText(const Quantity& quantity, std::string_view group) {
    if (quantity.aim == Aim::None) return {};
    const std::string relation = quantity.aim == Aim::AtMost ? "≤ " : "≥ ";
    return relation + withUnit(quantity.limit, quantity.unit, group);
}

}  // namespace cortex::profiler
