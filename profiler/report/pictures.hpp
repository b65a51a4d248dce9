// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/results.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace cortex::profiler {

// Where an axis has numbers, in what it shows.
struct Ticks {
    double low = 0, high = 1;       // ends of the axis
    std::vector<double> at;         // with a number, two at least
    std::vector<double> between{};  // without
};
// An axis on which these values have room. Whole values, such as counts, have whole numbers.
Ticks ticksOf(const std::vector<double>& values, bool logarithmic);

// The commands for gnuplot that draw the figure from `name`.csv into `name`.svg.
std::string gnuplotScript(const Figure& figure, const std::string& name);

// Draws each figure that has something to show from its CSV file in the folder, with gnuplot.
// Nothing, or why there are no pictures and what to do.
std::string drawPictures(const std::vector<Figure>& figures, const std::vector<std::string>& names,
                         const std::filesystem::path& folder);

}  // namespace cortex::profiler
