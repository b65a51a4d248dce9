// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/results.hpp"

#include <string>
#include <vector>

namespace cortex::profiler {

// A figure as SVG, styled by the classes of the page around it.
struct Plot {
    std::string svg;
    std::string legend;              // HTML, to stand below
    std::vector<std::string> notes;  // what the plot could not show, plain text
};
Plot plotOf(const Figure& figure);

// Of neighbours in the same column of pixels only the first, the least, the greatest and the last
// stay, in their order.
std::vector<Point> thinned(const std::vector<Point>& pixels);

}  // namespace cortex::profiler
