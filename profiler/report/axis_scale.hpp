// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/results.hpp"

#include <optional>
#include <string>
#include <vector>

namespace cortex::profiler {

bool drawable(double value, bool logarithmic);  // has a place on such an axis

// Round numbers within low and high, about `wanted` of them, 1, 2 or 5 times a power of ten apart.
std::vector<double> linearTicks(double low, double high, std::size_t wanted);

// Powers of ten; also 2 and 5 times those where there are less than four. Needs 0 < low.
std::vector<double> logarithmicTicks(double low, double high, std::size_t wanted);

// What an axis shows, and how much of it.
struct Span {
    double low = 0, high = 1;
};

// Widened so that lines do not lie on the border and equal values do not divide by nothing. Round
// ends are for axes of values: those begin at zero where that costs less than half of the plot.
Span shownSpan(Span data, bool logarithmic, bool roundEnds);

// With `at` in it as well; nothing where the data would keep less than two fifths of the axis.
std::optional<Span> widened(Span data, double at, bool logarithmic);

struct Tick {
    double at = 0;
    std::string text;
};

// Values to pixels along one axis.
class Scale {
public:
    Scale(Span span, bool logarithmic, double from, double to)
        : span_{span}, logarithmic_{logarithmic}, from_{from}, to_{to} {}

    double pixel(double value) const;
    bool shows(double value) const { return value >= span_.low && value <= span_.high; }
    std::vector<Tick> ticks(std::size_t wanted) const;
    std::vector<double> lesserTicks() const;  // without text; of logarithmic scales only
    int exponent() const;  // of ten, by which the texts of a linear scale are less: 0, 3, 6, -3…

private:
    Span span_;
    bool logarithmic_;
    double from_, to_;
};

}  // namespace cortex::profiler
