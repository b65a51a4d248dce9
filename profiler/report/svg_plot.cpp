// SPDX-License-Identifier: Apache-2.0
#include "report/svg_plot.hpp"

#include "report/axis_scale.hpp"
#include "report/number_text.hpp"
#include "report/svg_shapes.hpp"
#include "report/text_columns.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

namespace cortex::profiler {
namespace {

constexpr double width = 800, plotHeight = 320;
constexpr double letter = 6.9, line = 15;              // of the text in a plot
constexpr std::size_t markColumn = 20, markLines = 4;  // of texts beside the plot
constexpr std::size_t fewPoints = 60;                  // a marker for each
constexpr std::size_t xTicks = 8, yTicks = 6;

std::string axisTitle(const Axis& axis, int exponent) {
    std::string unit = axis.unit;
    if (exponent != 0) unit = powerOfTen(exponent) + (unit.empty() ? "" : " " + unit);
    return unit.empty() ? axis.label : axis.label + " (" + unit + ")";
}

std::string valueOf(const Axis& axis, double value) {
    return readable(value) + (axis.unit.empty() ? "" : " " + axis.unit);
}

std::vector<std::string> markLinesOf(const std::string& text) {
    std::vector<std::string> lines = wrappedText(text, markColumn);
    if (lines.size() > markLines) {
        lines.resize(markLines);
        lines.back() += "…";
    }
    for (std::string& each : lines) each = clipped(each, markColumn);
    return lines;
}

// Lays a figure out and draws it, from back to front.
class Drawing {
public:
    explicit Drawing(const Figure& figure);
    Plot plot() &&;

private:
    struct MarkText {
        const Mark* mark;
        std::vector<std::string> lines;
        double at = 0;  // where it is wished, then where it is
    };

    bool drawable(const Point& point) const {
        return profiler::drawable(point.x, figure_.x.logarithmic) &&
               profiler::drawable(point.y, figure_.y.logarithmic);
    }
    void findSpans();
    void widenForMarks();
    void layOut();
    void placeBeside();
    void placeAbove();
    void drawAxes();
    void drawMarks();
    std::size_t indexOf(const Series& series) const;  // among those of its kind
    void drawSeries(const Series& series, std::size_t index);
    void drawMarkers(const Series& series, std::size_t index);
    double x(double value) const { return xScale_.pixel(value); }
    double y(double value) const { return yScale_.pixel(value); }
    void text(double atX, double atY, const char* kind, const std::string& what) {
        svg_ += shapes::text(atX, atY, kind, what);
    }

    const Figure& figure_;
    Plot plot_;
    std::string& svg_ = plot_.svg;
    bool empty_ = true;
    Span xData_{}, yData_{};
    std::vector<MarkText> beside_, above_;
    std::size_t rowsAbove_ = 0;
    double left_ = 0, right_ = 0, top_ = 0, bottom_ = 0;
    Scale xScale_{{}, false, 0, 1}, yScale_{{}, false, 0, 1};
};

Drawing::Drawing(const Figure& figure) : figure_{figure} {
    findSpans();
    widenForMarks();
    layOut();
}

void Drawing::findSpans() {
    std::size_t lacking = 0, outside = 0;
    for (const Series& series : figure_.series) {
        for (const Point& point : series.points) {
            if (!std::isfinite(point.x) || !std::isfinite(point.y)) {
                ++lacking;
            } else if (!drawable(point)) {
                ++outside;
            } else if (empty_) {
                xData_ = {point.x, point.x};
                yData_ = {point.y, point.y};
                empty_ = false;
            } else {
                xData_ = {std::min(xData_.low, point.x), std::max(xData_.high, point.x)};
                yData_ = {std::min(yData_.low, point.y), std::max(yData_.high, point.y)};
            }
        }
    }
    const auto note = [&](std::size_t count, const std::string& why) {
        if (count == 0) return;
        plot_.notes.push_back(std::to_string(count) + (count == 1 ? " point" : " points") +
                              " not shown: " + why);
    };
    note(lacking, "without a value");
    note(outside, "zero, negative or too large for the axes");
    if (empty_ && figure_.x.logarithmic) xData_ = {1, 10};
    if (empty_ && figure_.y.logarithmic) yData_ = {1, 10};
}

void Drawing::widenForMarks() {
    for (const Mark& mark : figure_.marks) {
        const bool across = mark.along == Mark::Along::Y;
        const Axis& axis = across ? figure_.y : figure_.x;
        Span& data = across ? yData_ : xData_;
        const auto found = widened(data, mark.at, axis.logarithmic);
        if (empty_ || !found) {
            plot_.notes.push_back("Outside of the plot: " + mark.text + " (" + axis.label + " " +
                                  valueOf(axis, mark.at) + ")");
            continue;
        }
        data = *found;
        if (across) {
            beside_.push_back({&mark, markLinesOf(mark.text)});
        } else {
            above_.push_back({&mark, {clipped(mark.text, 60)}});
        }
    }
}

void Drawing::layOut() {
    const Span xSpan = shownSpan(xData_, figure_.x.logarithmic, false);
    const Span ySpan = shownSpan(yData_, figure_.y.logarithmic, true);
    double widest = 0;
    for (const Tick& tick : Scale{ySpan, figure_.y.logarithmic, 0, 1}.ticks(yTicks)) {
        widest = std::max(widest, static_cast<double>(characters(tick.text)) * letter);
    }
    left_ = 34 + widest;
    std::size_t column = 0;
    for (const MarkText& each : beside_) {
        for (const std::string& text : each.lines) column = std::max(column, characters(text));
    }
    right_ = width - (column == 0 ? 16 : static_cast<double>(column) * letter + 14);
    xScale_ = Scale{xSpan, figure_.x.logarithmic, left_, right_};
    placeAbove();
    top_ = 12 + static_cast<double>(rowsAbove_) * line;
    bottom_ = top_ + (empty_ ? plotHeight / 4 : plotHeight);
    yScale_ = Scale{ySpan, figure_.y.logarithmic, bottom_, top_};
    placeBeside();
}

// Texts of vertical lines in rows above the plot, none across another.
void Drawing::placeAbove() {
    std::vector<double> ends;  // of each row
    const auto half = [](const MarkText& text) {
        return static_cast<double>(characters(text.lines[0])) * letter / 2;
    };
    std::ranges::sort(above_, {}, [](const MarkText& each) { return each.mark->at; });
    for (MarkText& each : above_) {
        each.at = std::clamp(x(each.mark->at), left_ + half(each),
                             std::max(left_, width - 2 * half(each)) + half(each));
        const auto row = std::ranges::find_if(
            ends, [&](double end) { return end + letter < each.at - half(each); });
        const auto index = static_cast<std::size_t>(row - ends.begin());
        if (row == ends.end()) ends.push_back(0);
        ends[index] = each.at + half(each);
        each.lines.push_back(std::to_string(index));
    }
    rowsAbove_ = ends.size();
}

// Texts of horizontal lines to the right, moved apart; the picture grows where they need it.
void Drawing::placeBeside() {
    const auto height = [](const MarkText& text) {
        return static_cast<double>(text.lines.size()) * line + 4;
    };
    std::ranges::sort(beside_, std::greater{}, [](const MarkText& each) { return each.mark->at; });
    double end = 0;
    for (MarkText& each : beside_) {
        each.at = std::max(end, y(each.mark->at) - height(each) / 2);
        end = each.at + height(each);
    }
    double limit = bottom_ + line;
    for (auto each = beside_.rbegin(); each != beside_.rend(); ++each) {
        const double moved = std::min(each->at, limit - height(*each));
        if (moved < 0) break;
        each->at = limit = moved;
    }
}

void Drawing::drawAxes() {
    for (const double at : yScale_.lesserTicks()) {
        svg_ += shapes::line("tick", left_ - 3, y(at), left_, y(at));
    }
    for (const double at : xScale_.lesserTicks()) {
        svg_ += shapes::line("tick", x(at), bottom_, x(at), bottom_ + 3);
    }
    for (const Tick& tick : yScale_.ticks(yTicks)) {
        svg_ += shapes::line("grid", left_, y(tick.at), right_, y(tick.at));
        svg_ += shapes::line("tick", left_ - 5, y(tick.at), left_, y(tick.at));
        text(left_ - 8, y(tick.at) + 4, "end", tick.text);
    }
    for (const Tick& tick : xScale_.ticks(xTicks)) {
        svg_ += shapes::line("grid", x(tick.at), top_, x(tick.at), bottom_);
        svg_ += shapes::line("tick", x(tick.at), bottom_, x(tick.at), bottom_ + 5);
        text(x(tick.at), bottom_ + 19, "middle", tick.text);
    }
    svg_ += shapes::line("axis", left_, top_, left_, bottom_);
    svg_ += shapes::line("axis", left_, bottom_, right_, bottom_);
    text((left_ + right_) / 2, bottom_ + 40, "middle title",
         axisTitle(figure_.x, xScale_.exponent()));
    svg_ += shapes::uprightText(13, (top_ + bottom_) / 2, axisTitle(figure_.y, yScale_.exponent()));
}

void Drawing::drawMarks() {
    for (const MarkText& each : beside_) {
        const double at = y(each.mark->at);
        const double middle = each.at + static_cast<double>(each.lines.size()) * line / 2 + 1;
        svg_ += "<g><title>" + escaped(each.mark->text) + "</title>";
        svg_ += shapes::line("mark", left_, at, right_, at);
        svg_ += shapes::line("mark", right_, at, right_ + 8, middle);
        for (std::size_t i = 0; i < each.lines.size(); ++i) {
            text(right_ + 12, each.at + static_cast<double>(i + 1) * line - 2, "start of-mark",
                 each.lines[i]);
        }
        svg_ += "</g>";
    }
    for (const MarkText& each : above_) {
        const double base = top_ - 6 - std::stod(each.lines[1]) * line;
        svg_ += "<g><title>" + escaped(each.mark->text) + "</title>";
        svg_ += shapes::line("mark", x(each.mark->at), base + 3, x(each.mark->at), bottom_);
        text(each.at, base, "middle of-mark", each.lines[0]);
        svg_ += "</g>";
    }
}

std::size_t Drawing::indexOf(const Series& series) const {
    const std::span before{figure_.series.data(), &series};
    return static_cast<std::size_t>(std::ranges::count(before, series.baseline, &Series::baseline));
}

void Drawing::drawSeries(const Series& series, std::size_t index) {
    std::string path;
    std::vector<Point> run;
    const auto end = [&] {
        if (run.size() > 1) path += shapes::path(thinned(run));
        run.clear();
    };
    for (const Point& point : series.points) {
        if (drawable(point)) {
            run.push_back({x(point.x), y(point.y)});
        } else {
            end();
        }
    }
    end();
    svg_ += "<g class=\"" + shapes::kind(series, index) + "\"><title>" + escaped(series.name) +
            "</title>";
    if (!path.empty()) {
        svg_ += "<path class=\"" + shapes::lineKind(series) + "\" d=\"" + path + "\"/>";
    }
    svg_ += "</g>";
    if (series.points.size() <= fewPoints) drawMarkers(series, index);
}

void Drawing::drawMarkers(const Series& series, std::size_t index) {
    svg_ += "<g class=\"" + shapes::kind(series, index) + "\">";
    for (const Point& point : series.points) {
        if (!drawable(point)) continue;
        const std::string told =
            series.name + ": " + valueOf(figure_.y, point.y) + " at " + valueOf(figure_.x, point.x);
        svg_ += "<g><title>" + escaped(told) + "</title>" +
                shapes::marker(index, x(point.x), y(point.y)) + "</g>";
    }
    svg_ += "</g>\n";
}

Plot Drawing::plot() && {
    double height = bottom_ + 52;
    for (const MarkText& each : beside_) {
        height = std::max(height, each.at + static_cast<double>(each.lines.size() + 1) * line);
    }
    svg_ = shapes::begin(width, height, figure_.title);
    if (empty_) {
        text(width / 2, (top_ + bottom_) / 2, "middle", "Nothing was measured.");
    } else {
        drawAxes();
        drawMarks();
    }
    for (const Series& series : figure_.series) {
        const bool markers = series.points.size() <= fewPoints;
        plot_.legend += shapes::legendEntry(series, indexOf(series), markers);
    }
    for (const bool baselines : {true, false}) {
        for (const Series& series : figure_.series) {
            if (series.baseline == baselines && !empty_) drawSeries(series, indexOf(series));
        }
    }
    svg_ += "</svg>\n";
    return std::move(plot_);
}

}  // namespace

Plot plotOf(const Figure& figure) { return Drawing{figure}.plot(); }

std::vector<Point> thinned(const std::vector<Point>& pixels) {
    std::vector<Point> result;
    for (std::size_t begin = 0, end = 0; begin < pixels.size(); begin = end) {
        std::size_t least = begin, greatest = begin;
        const double column = std::floor(pixels[begin].x);
        for (; end < pixels.size() && std::floor(pixels[end].x) == column; ++end) {
            if (pixels[end].y < pixels[least].y) least = end;
            if (pixels[end].y > pixels[greatest].y) greatest = end;
        }
        std::vector kept{begin, std::min(least, greatest), std::max(least, greatest), end - 1};
        kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
        for (const std::size_t each : kept) result.push_back(pixels[each]);
    }
    return result;
}

}  // namespace cortex::profiler
