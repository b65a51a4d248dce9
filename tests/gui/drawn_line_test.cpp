// SPDX-License-Identifier: Apache-2.0
// What a panel draws of a line, from its pixels, and the numbers of its axis.
#include "made_agent.hpp"
#include "plots/plot_panel.hpp"
#include "style/look.hpp"

#include <QImage>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <set>
#include <vector>

#include <qwt_scale_div.h>
#include <qwt_scale_draw.h>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace gui;

constexpr std::array lengths{1.0, 3.0, 5.0, 20.0, 60.0, 300.0, 600.0};  // s, of samples at 1 kHz

// A line in the dashes of this colour of the series; of a demand: below it.
PlotLine dashed(int colour) {
    PlotLine line;
    line.demand = colour < 4;
    line.colour = std::max(colour, 0);
    return line;
}

class Canvas {
public:
    Canvas(const PlotLine& line, double span, const std::function<double(std::int64_t)>& value)
        : colour_{line.pen(1).color()}, span_{span} {
        const auto count = static_cast<std::int64_t>(span * 1'000);
        for (std::int64_t i = 0; i <= count; ++i) {
            ring_.put(i, value(i), 0);
            time_.table.add(i, MadeAgent::start + i * MadeAgent::period, MadeAgent::period);
        }
        panel.resize(700, 300);
        show(line);
        show(line);  // with the edges that the numbers of the axis leave
        image_ = panel.grab().toImage();
    }

    int left() const { return panel.canvasBox().left(); }
    int right() const { return panel.canvasBox().right(); }
    double width() const { return panel.canvasBox().width(); }
    double columnOf(std::int64_t sample) const {
        return left() + static_cast<double>(sample) * 1e-3 / span_ * width();
    }
    // Whether there is ink in a column between two values.
    bool isInked(int column, double from, double to) const {
        const QRect canvas = panel.canvasBox();
        const int top = std::max(static_cast<int>(panel.yOf(to, false)), canvas.top());
        const int bottom = std::min(static_cast<int>(panel.yOf(from, false)), canvas.bottom());
        if (column < left() || column > right()) return false;
        for (int y = top; y <= bottom; ++y) {
            if (isInk(image_.pixelColor(column, y))) return true;
        }
        return false;
    }
    // About this sample, between two values.
    bool isDrawn(std::int64_t sample, double from, double to) const {
        const int column = static_cast<int>(columnOf(sample));
        for (int each = column - 2; each <= column + 2; ++each) {
            if (isInked(each, from, to)) return true;
        }
        return false;
    }
    int blanks() const {
        int count = 0;
        for (int column = left(); column <= right(); ++column) {
            count += !isInked(column, panel.axisInterval(QwtPlot::yLeft).minValue(),
                              panel.axisInterval(QwtPlot::yLeft).maxValue());
        }
        return count;
    }

    PlotPanel panel;

private:
    void show(const PlotLine& line) {
        const double from = static_cast<double>(MadeAgent::start) * 1e-9;
        panel.show({DrawnLine{line, &ring_, &time_, 0}}, {from, from + span_}, false);
    }
    // At least a third of the way from the canvas to the colour of the line.
    bool isInk(const QColor& found) const {
        const QColor back = Look::colours().canvas;
        const int whole = std::abs(colour_.red() - back.red()) +
                          std::abs(colour_.green() - back.green()) +
                          std::abs(colour_.blue() - back.blue());
        const int off = std::abs(found.red() - colour_.red()) +
                        std::abs(found.green() - colour_.green()) +
                        std::abs(found.blue() - colour_.blue());
        return off * 3 < whole * 2;
    }

    QColor colour_;
    double span_;
    Ring ring_;
    AgentTime time_;
    QImage image_;
};

// Forty moments, about evenly, beside all grids.
std::vector<std::int64_t> momentsOf(double span) {
    std::vector<std::int64_t> all;
    for (int i = 0; i < 40; ++i) {
        all.push_back(static_cast<std::int64_t>(span * (i * 24.37 + 9.1 + i % 7)));
    }
    return all;
}

TEST(DrawnLine, NoSpikeOfOneCycleVanishesInADashedLine) {
    for (const int colour : {3, 4, 5, 6, 7}) {
        for (const double span : lengths) {
            for (const double height : {1.0, 0.04}) {
                const auto spikes = momentsOf(span);
                const std::set<std::int64_t> known{spikes.begin(), spikes.end()};
                const Canvas canvas{dashed(colour), span, [&](std::int64_t i) {
                                        if (i == 5) return 1.0;
                                        return known.contains(i) ? height : 0.0;
                                    }};
                const auto drawn = std::ranges::count_if(spikes, [&](std::int64_t each) {
                    return canvas.isDrawn(each, height * 0.6, height);
                });
                EXPECT_EQ(drawn, 40) << height << " high, of " << span << " s, " << colour;
                EXPECT_GT(canvas.blanks(), 30) << "dashed, of " << span << " s, " << colour;
            }
        }
    }
}

TEST(DrawnLine, NoEdgeVanishesInADashedLine) {
    for (const int colour : {3, 4, 5, 6, 7}) {
        for (const double span : lengths) {
            const auto edges = momentsOf(span);
            const Canvas canvas{dashed(colour), span, [&](std::int64_t i) {
                                    return std::ranges::upper_bound(edges, i) - edges.begin() & 1;
                                }};
            const auto drawn = std::ranges::count_if(
                edges, [&](std::int64_t each) { return canvas.isDrawn(each, 0.4, 0.6); });
            EXPECT_EQ(drawn, 40) << "of " << span << " s, " << colour;
            EXPECT_GT(canvas.blanks(), 30) << "dashed, of " << span << " s, " << colour;
        }
    }
}

TEST(DrawnLine, WhatIsSteepButEvenIsDashed) {
    for (const double span : lengths) {
        const Canvas canvas{dashed(3), span, [&](std::int64_t i) {
                                return std::sin(static_cast<double>(i) * 1e-3 / span * 12);
                            }};
        EXPECT_GT(canvas.blanks(), canvas.width() / 5) << "of " << span << " s";
    }
}

TEST(DrawnLine, TheNumbersOfItsAxisAreToldApart) {
    struct Range {
        double low, high;
    };
    for (const auto& [low, high] : {Range{-1e300, 1e300}, Range{-1.7e308, 1.7e308},
                                    Range{1e9 - 1e-4, 1e9 + 1e-4}, Range{1e16 - 1e11, 1e16 + 1e11},
                                    Range{-1e9 - 3e4, -1e9 + 3e4}, Range{0, 1}, Range{0, 3e8}}) {
        const Canvas canvas{PlotLine{}, 5,
                            [&](std::int64_t i) { return i % 500 < 250 ? low : high; }};
        const QwtInterval shown = canvas.panel.axisInterval(QwtPlot::yLeft);
        EXPECT_TRUE(std::isfinite(shown.width())) << high;
        QSet<QString> texts;
        const auto ticks = canvas.panel.axisScaleDiv(QwtPlot::yLeft).ticks(QwtScaleDiv::MajorTick);
        for (const double each : ticks) {
            texts.insert(canvas.panel.axisScaleDraw(QwtPlot::yLeft)->label(each).text());
        }
        const QString all = QStringList{texts.begin(), texts.end()}.join(' ');
        ASSERT_GE(texts.size(), 3) << high << ' ' << all.toStdString();
        EXPECT_EQ(texts.size(), ticks.size()) << all.toStdString();
        EXPECT_LE(std::ranges::max(texts, {}, &QString::size).size(), 14) << all.toStdString();
        if (high > 1e307) continue;  // beyond the greatest axis
        EXPECT_TRUE(
            canvas.isDrawn(125, shown.minValue(), shown.minValue() / 2 + shown.maxValue() / 2))
            << high;
        EXPECT_TRUE(
            canvas.isDrawn(375, shown.minValue() / 2 + shown.maxValue() / 2, shown.maxValue()))
            << high;
    }
}

}  // namespace
}  // namespace cortex::test
