// SPDX-License-Identifier: Apache-2.0
#include "report/comparison.hpp"

#include "report/machine_facts.hpp"
#include "report/number_text.hpp"
#include "report/quantity_text.hpp"
#include "report/statistics.hpp"
#include "report/summary_text.hpp"
#include "text/plain_text.hpp"
#include "text/text_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cortex::profiler {
namespace {

constexpr double unknownNoise = 0.05, leastNoise = 0.01;
constexpr double deviations = 3, deviationOfMad = 1.4826;  // of normally distributed repeats
constexpr std::array changes{"worse", "better", "noise", "not comparable"};

double spread(std::vector<double> values) {
    if (values.size() < 5) return std::ranges::max(values) - std::ranges::min(values);
    const double middle = median(values);
    for (double& each : values) each = std::abs(each - middle);
    return deviations * deviationOfMad * median(values);
}

const Quantity* find(const std::vector<Quantity>& quantities, const std::string& id) {
    const auto found = std::ranges::find(quantities, id, &Quantity::id);
    return found == quantities.end() ? nullptr : &*found;
}

Compared compared(const Quantity& before, const Quantity& after) {
    Compared result{before, after, Change::Noise, 0, {}};
    if (!std::isfinite(before.value) || !std::isfinite(after.value) || before.unit != after.unit ||
        before.lessIsBetter != after.lessIsBetter) {
        result.change = Change::NotComparable;
        return result;
    }
    const double change = after.value - before.value;
    result.noise = std::max(noiseOf(before), noiseOf(after));
    if (before.value * after.value > 0) result.ratio = after.value / before.value;
    if (std::abs(change) > result.noise) {
        result.change = (change < 0) == before.lessIsBetter ? Change::Better : Change::Worse;
    }
    return result;
}

using Facts = std::vector<std::pair<std::string, std::string>>;

std::string valueOf(const Facts& facts, const std::string& fact) {
    const auto found =
        std::ranges::find(facts, fact, [](const auto& each) -> auto& { return each.first; });
    return found == facts.end() ? "not told" : found->second;
}

std::vector<std::string> differences(const Facts& before, const Facts& after) {
    Facts all = before;
    for (const auto& each : after) {
        if (valueOf(before, each.first) == "not told") all.push_back(each);
    }
    std::vector<std::string> result;
    for (const auto& [fact, value] : all) {
        const std::string first = valueOf(before, fact), then = valueOf(after, fact);
        if (first != then && fact != loadFact) {
            result.push_back(fact + ": " + first + ", then " + then);
        }
    }
    return result;
}

std::string name(const Results& results) {
    return results.started + (results.version.empty() ? "" : ", CorteX " + results.version);
}

std::string percent(double part, double of) {
    return of == 0 || !std::isfinite(of)
               ? ""
               : readable(std::round(std::abs(part / of) * 1000) / 10) + " %";
}

cli::TextLine rowOf(const Compared& each) {
    const bool told = each.change != Change::NotComparable;
    return {{each.before.what},
            {valueText(each.before)},
            {valueText(each.after)},
            {each.ratio ? readable(*each.ratio) + "×" : ""},
            {told ? percent(each.noise, each.before.value) : ""},
            {changes[static_cast<std::size_t>(each.change)]}};
}

std::string counts(const Comparison& comparison) {
    std::array<std::size_t, changes.size()> found{};
    for (const Compared& each : comparison.quantities) {
        ++found[static_cast<std::size_t>(each.change)];
    }
    return std::to_string(found[0]) + " worse, " + std::to_string(found[1]) + " better, " +
           std::to_string(found[2]) + " within noise, " + std::to_string(found[3]) +
           " not comparable\n";
}

std::string only(const char* side, const std::vector<Quantity>& quantities) {
    std::string text;
    for (const Quantity& each : quantities) {
        text += std::string{"only "} + side + ": " + printable(each.what) + ", " +
                printable(valueText(each)) + "\n";
    }
    return text;
}

}  // namespace

double noiseOf(const Quantity& quantity) {
    std::vector<double> repeats = quantity.repeats;
    std::erase_if(repeats, [](double each) { return !std::isfinite(each); });
    const double size = std::abs(quantity.value);
    if (repeats.size() < 2) return unknownNoise * size;
    return std::max(spread(std::move(repeats)), leastNoise * size);
}

Comparison compare(const Results& before, const Results& after) {
    Comparison result;
    result.before = name(before);
    result.after = name(after);
    result.otherMachine = differences(before.machine, after.machine);
    result.complete = before.complete && after.complete;
    for (const Quantity& each : before.quantities) {
        if (const Quantity* other = find(after.quantities, each.id)) {
            result.quantities.push_back(compared(each, *other));
        } else {
            result.onlyBefore.push_back(each);
        }
    }
    for (const Quantity& each : after.quantities) {
        if (!find(before.quantities, each.id)) result.onlyAfter.push_back(each);
    }
    return result;
}

std::string comparisonText(const Comparison& comparison, std::size_t width) {
    std::string text;
    if (!comparison.otherMachine.empty()) {
        text += "DIFFERENT MACHINES or settings: the changes below say little of the code.\n";
        for (const std::string& each : comparison.otherMachine) {
            text += "  " + printable(each) + "\n";
        }
        text += "\n";
    }
    text += "before: " + printable(comparison.before) + "\nafter:  " + printable(comparison.after) +
            "\n";
    if (!comparison.complete) text += "Not complete: one of the two runs was stopped.\n";
    cli::TextTable table{{{"", "what", 9, 0, false, true},
                          {"", "before", 5},
                          {"", "after", 6},
                          {"", "ratio", 7},
                          {"", "noise", 4},
                          {"", "", 8, 0, false}}};
    for (const Change change :
         {Change::Worse, Change::Better, Change::NotComparable, Change::Noise}) {
        for (const Compared& each : comparison.quantities) {
            if (each.change == change) table.add(rowOf(each));
        }
    }
    text += "\n" + tableText(table, width);
    text += "\n" + counts(comparison);
    return text + only("before", comparison.onlyBefore) + only("after", comparison.onlyAfter);
}

}  // namespace cortex::profiler
