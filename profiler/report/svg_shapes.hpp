// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/results.hpp"

#include <string>
#include <vector>

// Elements of SVG and the classes by which the page styles them. Texts are escaped here.
namespace cortex::profiler::shapes {

std::string begin(double width, double height, const std::string& title);
std::string line(const char* kind, double x1, double y1, double x2, double y2);
std::string text(double x, double y, const char* kind, const std::string& what);
std::string uprightText(double x, double y, const std::string& what);
std::string path(const std::vector<Point>& pixels);  // of the attribute d

// The nth series, or the nth baseline, has its own colour, dashes and marker.
std::string kind(const Series& series, std::size_t index);
std::string lineKind(const Series& series);
std::string marker(std::size_t index, double x, double y);
std::string legendEntry(const Series& series, std::size_t index, bool withMarker);

}  // namespace cortex::profiler::shapes
