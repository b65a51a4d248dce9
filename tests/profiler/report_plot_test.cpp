// SPDX-License-Identifier: Apache-2.0
#include "profiler/report_results.hpp"
#include "report/html_report.hpp"
#include "report/svg_plot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <regex>

#include <gtest/gtest.h>

namespace cortex::profiler {
namespace {

Figure figureOf(std::vector<Point> points) {
    Figure figure;
    figure.id = "figure";
    figure.title = "Title";
    figure.x = {"time", "s"};
    figure.y = {"lateness", "µs"};
    figure.series = {{"line", std::move(points), false}};
    return figure;
}

struct Text {
    double x, y;
    std::string what;
};

std::vector<Text> textsOf(const std::string& svg, const std::string& kind) {
    std::vector<Text> texts;
    const std::regex pattern{"<text class=\"" + kind +
                             "\" x=\"([-0-9.]+)\" y=\"([-0-9.]+)\">([^<]*)<"};
    for (std::sregex_iterator each{svg.begin(), svg.end(), pattern}, end; each != end; ++each) {
        texts.push_back({std::stod((*each)[1]), std::stod((*each)[2]), (*each)[3]});
    }
    return texts;
}

bool holdsOnlyNumbers(const std::string& svg) {
    return svg.find("nan") == std::string::npos && svg.find("inf") == std::string::npos;
}

TEST(ReportPlot, FewPointsHaveMarkersThatTellTheirValues) {
    const std::string svg = plotOf(figureOf({{1, 20}, {2, 30.5}})).svg;

    EXPECT_EQ(count(svg, "<circle"), 2U);
    EXPECT_NE(svg.find("<title>line: 30.5 µs at 2 s</title>"), std::string::npos);
}

TEST(ReportPlot, ManyPointsHaveNoMarkers) {
    std::vector<Point> points;
    for (int i = 0; i < 500; ++i) points.push_back({double(i), std::sin(i)});

    EXPECT_EQ(count(plotOf(figureOf(points)).svg, "<circle"), 0U);
}

TEST(ReportPlot, AxesSayWhatTheyShowAndItsUnit) {
    const std::string svg = plotOf(figureOf({{0, 0}, {2e7, 3}})).svg;

    EXPECT_NE(svg.find(">time (10⁶ s)<"), std::string::npos);
    EXPECT_NE(svg.find(">lateness (µs)<"), std::string::npos);
}

TEST(ReportPlot, ThinningKeepsExtremesAndTheirOrder) {
    std::vector<Point> points;
    for (int i = 0; i < 100000; ++i) points.push_back({i * 0.008, 100 + std::sin(i)});
    points[43210].y = 1000;
    points[76543].y = -5;

    const std::vector<Point> thin = thinned(points);

    EXPECT_LT(thin.size(), 4U * 801);
    EXPECT_TRUE(std::ranges::is_sorted(thin, {}, &Point::x));
    EXPECT_EQ(std::ranges::max(thin, {}, &Point::y).x, points[43210].x);
    EXPECT_EQ(std::ranges::min(thin, {}, &Point::y).x, points[76543].x);
    EXPECT_EQ(thin.front().x, points.front().x);
    EXPECT_EQ(thin.back().x, points.back().x);
}

TEST(ReportPlot, ThinningLeavesFewPointsAsTheyAre) {
    EXPECT_EQ(thinned({{0, 1}, {1, 5}, {2, 1}}).size(), 3U);
    EXPECT_EQ(thinned({{0.1, 1}, {0.2, 5}, {0.3, 1}}).size(), 3U);
    EXPECT_TRUE(thinned({}).empty());
}

TEST(ReportPlot, LongSeriesMakeSmallFiles) {
    std::vector<Point> points;
    for (int i = 0; i < 200000; ++i) points.push_back({double(i), double(i * 7919 % 1000)});

    EXPECT_LT(plotOf(figureOf(points)).svg.size(), 60000U);
}

TEST(ReportPlot, WithoutPointsItSaysSo) {
    EXPECT_NE(plotOf(figureOf({})).svg.find("Nothing was measured"), std::string::npos);
    Figure figure = figureOf({});
    figure.series.clear();
    figure.x.logarithmic = figure.y.logarithmic = true;
    figure.marks = {{Mark::Along::Y, 5, "a mark"}};

    const Plot plot = plotOf(figure);

    EXPECT_NE(plot.svg.find("Nothing was measured"), std::string::npos);
    EXPECT_TRUE(holdsOnlyNumbers(plot.svg));
}

TEST(ReportPlot, OnePointAndEqualValuesAreDrawnInTheMiddle) {
    for (const bool logarithmic : {false, true}) {
        for (const double value : {7.0, 1e-50, 1e50}) {
            Figure figure = figureOf({{value, value}, {value, value}});
            figure.x.logarithmic = figure.y.logarithmic = logarithmic;

            const std::string svg = plotOf(figure).svg;

            EXPECT_EQ(count(svg, "<circle"), 2U);
            EXPECT_TRUE(holdsOnlyNumbers(svg)) << value;
            EXPECT_GE(textsOf(svg, "end").size(), 2U) << value;
            EXPECT_GE(textsOf(svg, "middle").size(), 2U) << value;
        }
    }
}

TEST(ReportPlot, WhatHasNoLogarithmIsLeftOutAndSaid) {
    Figure figure = figureOf({{1, 10}, {2, 0}, {3, -4}, {4, 20}});
    figure.y.logarithmic = true;

    const Plot plot = plotOf(figure);

    EXPECT_EQ(count(plot.svg, "<circle"), 2U);
    ASSERT_EQ(plot.notes.size(), 1U);
    EXPECT_EQ(plot.notes[0].substr(0, 18), "2 points not shown");
}

TEST(ReportPlot, WhatIsNotANumberIsLeftOutAndInterruptsTheLine) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    const double infinite = std::numeric_limits<double>::infinity();

    const Plot plot =
        plotOf(figureOf({{0, 1}, {1, 2}, {2, none}, {3, 1}, {4, 2}, {infinite, 1}, {9, 1e200}}));

    EXPECT_EQ(count(plot.svg, "<circle"), 4U);
    const std::size_t line = plot.svg.find("<path class=\"line\"");
    ASSERT_NE(line, std::string::npos);
    EXPECT_EQ(count(plot.svg.substr(line, plot.svg.find("/>", line) - line), "M"), 2U);
    EXPECT_EQ(plot.notes.size(), 2U);
    EXPECT_TRUE(holdsOnlyNumbers(plot.svg));
}

TEST(ReportPlot, MarksNearbyAreShownAndThoseFarAwaySaid) {
    Figure figure = figureOf({{0, 10}, {10, 60}});
    figure.marks = {{Mark::Along::Y, 100, "limit"},
                    {Mark::Along::Y, 1e9, "far"},
                    {Mark::Along::X, -1e9, "long ago"},
                    {Mark::Along::X, std::numeric_limits<double>::infinity(), "never"}};

    const Plot plot = plotOf(figure);

    EXPECT_EQ(textsOf(plot.svg, "start of-mark").size(), 1U);
    EXPECT_EQ(textsOf(plot.svg, "middle of-mark").size(), 0U);
    ASSERT_EQ(plot.notes.size(), 3U);
    EXPECT_NE(plot.notes[0].find("far (lateness 1 000 000 000 µs)"), std::string::npos);
    EXPECT_TRUE(holdsOnlyNumbers(plot.svg));
}

TEST(ReportPlot, TextsOfMarksDoNotOverlap) {
    Figure figure = figureOf({{0, 0}, {100, 100}});
    for (int i = 0; i < 12; ++i) {
        figure.marks.push_back({Mark::Along::Y, 95 + i * 0.1, "a mark with a longer text"});
        figure.marks.push_back({Mark::Along::X, 2 + i * 0.1, "a mark with a longer text"});
    }

    const std::string svg = plotOf(figure).svg;

    std::vector<Text> beside = textsOf(svg, "start of-mark");
    ASSERT_GE(beside.size(), 12U);
    for (std::size_t i = 1; i < beside.size(); ++i) EXPECT_GE(beside[i].y - beside[i - 1].y, 14);
    const std::vector<Text> above = textsOf(svg, "middle of-mark");
    ASSERT_EQ(above.size(), 12U);
    for (const Text& one : above) {
        EXPECT_GT(one.y, 0);
        for (const Text& other : above) {
            const bool same = &one == &other;
            EXPECT_TRUE(same || std::abs(one.y - other.y) >= 14 || std::abs(one.x - other.x) > 150);
        }
    }
}

TEST(ReportPlot, BaselinesAreToldFromWhatIsMeasured) {
    Figure figure = figureOf({{0, 1}, {1, 2}});
    figure.series.push_back({"bare", {{0, 1}, {1, 1}}, true});

    const Plot plot = plotOf(figure);

    EXPECT_NE(plot.svg.find("class=\"b0\"><title>bare"), std::string::npos);
    EXPECT_LT(plot.svg.find("class=\"b0\""), plot.svg.find("class=\"c0\""));
    EXPECT_EQ(count(plot.legend, "<li>"), 2U);
}

TEST(ReportHtml, TextsAreEscapedWhereverTheyStand) {
    const std::string evil = "<script>alert('x')</script>&\"\x01";
    Results results = sampleResults();
    results.started = results.command = results.version = evil;
    results.machine = {{evil, evil}};
    results.notes = {evil};
    for (Quantity& each : results.quantities) {
        each.what = each.unit = each.baselineName = each.paper = evil;
    }
    Figure& figure = results.figures[0];
    figure.id = figure.title = figure.paper = figure.setup = evil;
    figure.x.label = figure.x.unit = figure.y.label = figure.y.unit = evil;
    for (Series& each : figure.series) each.name = evil;
    for (Mark& each : figure.marks) each.text = evil;
    figure.marks.push_back({Mark::Along::Y, 1e80, evil});

    const std::string page = htmlReport(results);

    EXPECT_EQ(count(page, "<script"), 0U);
    EXPECT_EQ(count(page, "\"\x01"), 0U);
    EXPECT_EQ(count(page, "&\""), 0U);
    EXPECT_GT(count(page, "&lt;script&gt;"), 20U);
}

TEST(ReportHtml, NeedsNothingFromElsewhere) {
    const std::string page = htmlReport(sampleResults());

    for (const char* part : {"http:", "https:", "src=", "@import", "url(", "<link", "<script"}) {
        EXPECT_EQ(count(page, part), 0U) << part;
    }
}

TEST(ReportHtml, SaysWhichAimsAreMet) {
    const std::string page = htmlReport(sampleResults());

    EXPECT_NE(page.find(">1 of 2<"), std::string::npos);
    EXPECT_EQ(count(page, "✓ met"), 1U);
    EXPECT_EQ(count(page, "✗ not met"), 1U);
    EXPECT_EQ(count(page, "<li>second: 41 234 (aim ≥ 50 000)</li>"), 1U);
}

TEST(ReportHtml, SaysWhenARunIsNotComplete) {
    Results results = sampleResults();
    EXPECT_EQ(htmlReport(results).find("Not complete"), std::string::npos);

    results.complete = false;

    EXPECT_NE(htmlReport(results).find("Not complete"), std::string::npos);
}

TEST(ReportHtml, EmptyResultsMakeAPage) {
    EXPECT_NE(htmlReport({}).find("</html>"), std::string::npos);
}

}  // namespace
}  // namespace cortex::profiler
