// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/results.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace cortex::profiler {

// NotComparable: no value on a side, or another unit or direction.
enum class Change { Worse, Better, Noise, NotComparable };

struct Compared {
    Quantity before, after;
    Change change = Change::Noise;
    double noise = 0;             // in the unit of the quantity: what is less is no change
    std::optional<double> ratio;  // after / before, where both are of one sign
};

struct Comparison {
    std::string before, after;              // when each was started, and of what version
    std::vector<std::string> otherMachine;  // facts that differ: "CPU: A, then B"
    std::vector<Compared> quantities;       // by id, in the order of `before`
    std::vector<Quantity> onlyBefore, onlyAfter;
    bool complete = true;  // both sides
};

// How far repeats of one side are apart by chance, in the unit of the quantity:
// - five repeats and more: 3 standard deviations, as estimated from the median absolute deviation
//   (3 × 1.4826 × MAD), which single outliers do not move;
// - two to four: greatest minus least;
// - fewer: nothing is known, 5 % of the value is taken.
// Never less than 1 % of the value.
double noiseOf(const Quantity& quantity);

// What changed by no more than the greater noise of the two sides is noise.
Comparison compare(const Results& before, const Results& after);

// Other machines first, then what is worse, better, not comparable, only on one side; noise is
// listed last.
std::string comparisonText(const Comparison& comparison, std::size_t width);

}  // namespace cortex::profiler
