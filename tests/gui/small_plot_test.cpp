// SPDX-License-Identifier: Apache-2.0
// The small plot that views of one's own show.
#include "cortex/explorer/small_plot.hpp"

#include "style/look.hpp"

#include <QImage>
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

namespace cortex::explorer {
namespace {

using gui::Look;

class Small : public testing::Test {
protected:
    Small() {
        plot.resize(400, 160);
        line = plot.addLine(QStringLiteral("position"));
    }
    // Thirty moments a second of a value, up to this time.
    void feed(double from, double to, std::optional<double> value) {
        for (double at = from; at < to; at += 1.0 / 30) plot.put(line, at, value);
        plot.setNow(to);
    }
    // How many pixels of about the colour there are from one share of the width to another.
    int pixels(const QColor& colour, double from, double to) {
        const QImage image = plot.grab().toImage();
        int count = 0;
        for (int x = static_cast<int>(image.width() * from); x < image.width() * to; ++x) {
            for (int y = 20; y < image.height() - 20; ++y) {
                const QColor found = image.pixelColor(x, y);
                count += std::abs(found.red() - colour.red()) < 40 &&
                         std::abs(found.green() - colour.green()) < 40 &&
                         std::abs(found.blue() - colour.blue()) < 40;
            }
        }
        return count;
    }

    SmallPlot plot{QStringLiteral("position"), QStringLiteral("rad")};
    int line = 0;
};

TEST_F(Small, DrawsTheLastTenSecondsUpToNow) {
    feed(100, 112, 0.5);
    const QColor colour = Look::colours().series[0];
    EXPECT_GT(pixels(colour, 0.2, 0.4), 40);
    EXPECT_GT(pixels(colour, 0.9, 0.97), 10);
    EXPECT_EQ(pixels(Look::colours().data, 0, 1), 0);
    EXPECT_TRUE(plot.accessibleDescription().contains("position 0.5 rad"));
}

TEST_F(Small, WhatDiffersByRoundingIsLevel) {
    double from = 100;
    for (const double level : {0.0, 0.451125, -1e9}) {
        const double rounding = std::max(std::abs(level) * 2e-14, 2e-17);
        for (int i = 0; i < 300; ++i) {
            plot.put(line, from + i / 30.0, level + (i % 2 == 0 ? rounding : 0));
        }
        plot.setNow(from + 10);
        const QImage image = plot.grab().toImage();
        const QColor colour = Look::colours().series[0];
        int upper = image.height(), lower = 0;
        for (int y = 0; y < image.height(); ++y) {
            const QColor found = image.pixelColor(image.width() / 2, y);
            if (std::abs(found.red() - colour.red()) > 60 ||
                std::abs(found.blue() - colour.blue()) > 60)
                continue;
            upper = std::min(upper, y);
            lower = std::max(lower, y);
        }
        EXPECT_LE(upper, lower) << level;
        EXPECT_LE(lower - upper, 3) << level;
        from += 1'000;  // what was is out of sight
    }
}

TEST_F(Small, HatchesWhatDidNotComeAndDrawsNoLineAcrossIt) {
    feed(100, 104, 0.5);
    feed(104, 106, std::nullopt);
    feed(106, 110, 0.5);
    EXPECT_GT(pixels(Look::colours().dataBg, 0.48, 0.6), 200);
    EXPECT_EQ(pixels(Look::colours().series[0], 0.48, 0.6), 0);
    EXPECT_EQ(pixels(Look::colours().data, 0.75, 0.95), 0);
}

TEST_F(Small, IsHatchedUpToNowWhereNothingComesAnyLonger) {
    feed(100, 105, 0.5);
    plot.setNow(110);
    EXPECT_GT(pixels(Look::colours().dataBg, 0.7, 0.9), 200);
    EXPECT_EQ(pixels(Look::colours().series[0], 0.7, 0.9), 0);
}

TEST_F(Small, SaysThatThereIsNoDataAndTakesNoMomentTwice) {
    EXPECT_TRUE(plot.accessibleDescription().contains("no data"));
    plot.put(line, 100, 1.0);
    plot.put(line, 100, 2.0);
    plot.put(line, 99, 3.0);
    plot.put(7, 101, 4.0);
    plot.setNow(100);
    EXPECT_TRUE(plot.accessibleDescription().contains("position 1 rad"));
}

TEST_F(Small, ShowsWhatIsOutsideOfItsLimits) {
    plot.setLimits(-1, 0.6);
    feed(100, 105, 0.5);
    feed(105, 110, 0.7);
    EXPECT_GT(pixels(Look::colours().warnBg, 0.3, 0.9), 100);
    EXPECT_GE(plot.minimumSizeHint().width(), 240);
    EXPECT_GE(plot.minimumSizeHint().height(), 100);
}

}  // namespace
}  // namespace cortex::explorer
