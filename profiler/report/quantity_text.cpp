// SPDX-License-Identifier: Apache-2.0
#include "report/quantity_text.hpp"

#include "report/number_text.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace cortex::profiler {
namespace {

std::string withUnit(double value, const std::string& unit) {
    const std::string text = readable(value);
    return unit.empty() || !std::isfinite(value) ? text : text + " " + unit;
}

}  // namespace

Quantity& Quantity::ofRepeats(std::vector<double> all) {
    repeats = std::move(all);
    return *this;
}

Quantity& Quantity::beside(double other, std::string name) {
    baseline = other;
    baselineName = std::move(name);
    return *this;
}

Quantity& Quantity::atMost(double aimed) {
    aim = Aim::AtMost;
    limit = aimed;
    return *this;
}

Quantity& Quantity::atLeast(double aimed) {
    aim = Aim::AtLeast;
    limit = aimed;
    return moreIsBetter();
}

Quantity& Quantity::moreIsBetter() {
    lessIsBetter = false;
    return *this;
}

Quantity& Quantity::inPaper(std::string text) {
    paper = std::move(text);
    return *this;
}

Quantity& Results::add(std::string id, std::string what, std::string unit, double value) {
    return quantities.emplace_back(
        Quantity{std::move(id), std::move(what), std::move(unit), value});
}

std::optional<double> ratioToBaseline(const Quantity& quantity) {
    const double ratio = quantity.value / quantity.baseline;
    return std::isfinite(ratio) ? std::optional{ratio} : std::nullopt;
}

std::optional<Verdict> verdictOf(const Quantity& quantity) {
    if (quantity.aim == Aim::None) return {};
    if (!quantity.doubt.empty()) return Verdict::NotJudged;
    const bool met = quantity.aim == Aim::AtMost ? quantity.value <= quantity.limit
                                                 : quantity.value >= quantity.limit;
    return met ? Verdict::Met : Verdict::Missed;
}

Aims aimsOf(const Results& results) {
    Aims aims;
    for (const Quantity& each : results.quantities) {
        const std::optional<Verdict> verdict = verdictOf(each);
        if (!verdict) continue;
        ++aims.all;
        const std::string text = each.what + ": " + valueText(each);
        if (verdict == Verdict::Missed)
            aims.missed.push_back(text + " (aim " + aimText(each) + ")");
        if (verdict == Verdict::NotJudged) aims.notJudged.push_back(text + ": " + each.doubt);
    }
    return aims;
}

int exitCodeOf(const Results& results) {
    if (!results.complete) return 1;
    return aimsOf(results).missed.empty() ? 0 : 4;
}

std::string valueText(const Quantity& quantity) { return withUnit(quantity.value, quantity.unit); }

std::string baselineText(const Quantity& quantity) {
    if (std::isnan(quantity.baseline)) return {};
    const std::string text = withUnit(quantity.baseline, quantity.unit);
    return quantity.baselineName.empty() ? text : quantity.baselineName + ": " + text;
}

std::string ratioText(const Quantity& quantity) {
    const std::optional<double> ratio = ratioToBaseline(quantity);
    return ratio ? readable(*ratio) + "×" : "";
}

std::string aimText(const Quantity& quantity) {
    if (quantity.aim == Aim::None) return {};
    return (quantity.aim == Aim::AtMost ? "≤ " : "≥ ") + withUnit(quantity.limit, quantity.unit);
}

std::string verdictText(const Quantity& quantity) {
    constexpr std::array texts{"met", "MISSED", "not judged"};
    const std::optional<Verdict> verdict = verdictOf(quantity);
    return verdict ? texts[static_cast<std::size_t>(*verdict)] : "";
}

}  // namespace cortex::profiler
