// SPDX-License-Identifier: Apache-2.0
#include "report/svg_shapes.hpp"

#include "report/number_text.hpp"

#include <array>
#include <cstdio>

namespace cortex::profiler::shapes {
namespace {

constexpr std::size_t colours = 6, dashes = 4, forms = 4;  // as in the style of the page

constexpr std::size_t manyPoints = 1000;  // lines cover each other

std::string number(double value) {
    std::array<char, 32> text{};
    const int length = std::snprintf(text.data(), text.size(), "%.1f", value);
    std::string result{text.data(), static_cast<std::size_t>(length)};
    if (result.ends_with(".0")) result.resize(result.size() - 2);
    return result;
}

std::string attribute(const char* name, double value) {
    return std::string{" "} + name + "=\"" + number(value) + "\"";
}

}  // namespace

std::string begin(double width, double height, const std::string& title) {
    return "<svg viewBox=\"0 0 " + number(width) + " " + number(height) +
           "\" role=\"img\" aria-label=\"" + escaped(title) + "\">\n";
}

std::string line(const char* kind, double x1, double y1, double x2, double y2) {
    return std::string{"<line class=\""} + kind + "\"" + attribute("x1", x1) + attribute("y1", y1) +
           attribute("x2", x2) + attribute("y2", y2) + "/>\n";
}

std::string text(double x, double y, const char* kind, const std::string& what) {
    return std::string{"<text class=\""} + kind + "\"" + attribute("x", x) + attribute("y", y) +
           ">" + escaped(what) + "</text>\n";
}

std::string uprightText(double x, double y, const std::string& what) {
    return "<text class=\"middle title\" transform=\"translate(" + number(x) + " " + number(y) +
           ") rotate(-90)\">" + escaped(what) + "</text>\n";
}

std::string path(const std::vector<Point>& pixels) {
    std::string result;
    for (const Point& each : pixels) {
        result += (result.empty() ? 'M' : 'L') + number(each.x) + " " + number(each.y);
    }
    return result;
}

std::string kind(const Series& series, std::size_t index) {
    return (series.baseline ? "b" : "c") +
           std::to_string(index % (series.baseline ? dashes : colours));
}

std::string lineKind(const Series& series) {
    return series.points.size() > manyPoints ? "line dense" : "line";
}

std::string marker(std::size_t index, double x, double y) {
    const std::string at = "M" + number(x) + " " + number(y);
    switch (index % forms) {
        case 0:
            return "<circle" + attribute("cx", x) + attribute("cy", y) + " r=\"3.6\"/>";
        case 1:
            return "<path d=\"" + at + "m-3.3-3.3h6.6v6.6h-6.6z\"/>";
        case 2:
            return "<path d=\"" + at + "m0-4.4l4.2 7.4h-8.4z\"/>";
        default:
            return "<path d=\"" + at + "m0-4.8l4.4 4.8l-4.4 4.8l-4.4-4.8z\"/>";
    }
}

std::string legendEntry(const Series& series, std::size_t index, bool withMarker) {
    std::string sample =
        "<svg class=\"sample\" viewBox=\"0 0 34 12\" aria-hidden=\"true\"><g class=\"" +
        kind(series, index) + "\"><path class=\"" + lineKind(series) + "\" d=\"M1 6H33\"/>";
    if (withMarker) sample += marker(index, 17, 6);
    return "<li>" + sample + "</g></svg> " + escaped(series.name) + "</li>\n";
}

}  // namespace cortex::profiler::shapes
