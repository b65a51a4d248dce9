// SPDX-License-Identifier: Apache-2.0
#include "report/axis_scale.hpp"
#include "report/number_text.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>

#include <gtest/gtest.h>

namespace cortex::profiler {
namespace {

std::vector<std::string> texts(const Scale& scale, std::size_t wanted) {
    std::vector<std::string> result;
    for (const Tick& each : scale.ticks(wanted)) result.push_back(each.text);
    return result;
}

using Texts = std::vector<std::string>;

TEST(ReportAxis, TicksAreRoundNumbers) {
    EXPECT_EQ(texts(Scale{{0, 100}, false, 0, 1}, 6), (Texts{"0", "20", "40", "60", "80", "100"}));
    EXPECT_EQ(texts(Scale{{0.1, 0.9}, false, 0, 1}, 4), (Texts{"0.2", "0.4", "0.6", "0.8"}));
    EXPECT_EQ(texts(Scale{{-1, 1}, false, 0, 1}, 4), (Texts{"-1.0", "-0.5", "0.0", "0.5", "1.0"}));
    EXPECT_EQ(texts(Scale{{0, 40000}, false, 0, 1}, 4),
              (Texts{"0", "10 000", "20 000", "30 000", "40 000"}));
}

TEST(ReportAxis, GreatNumbersAreSaidInPowersOfAThousand) {
    const Scale scale{{0, 2.5e7}, false, 0, 1};

    EXPECT_EQ(scale.exponent(), 6);
    EXPECT_EQ(texts(scale, 5), (Texts{"0", "5", "10", "15", "20", "25"}));
}

TEST(ReportAxis, LogarithmicTicksAreDecadesAndAFewBetween) {
    EXPECT_EQ(texts(Scale{{10, 100}, true, 0, 1}, 6), (Texts{"10", "20", "50", "100"}));
    EXPECT_EQ(texts(Scale{{1, 1e5}, true, 0, 1}, 6),
              (Texts{"1", "10", "100", "1000", "10 000", "100 000"}));
    EXPECT_EQ(texts(Scale{{1e-4, 10}, true, 0, 1}, 6),
              (Texts{"10⁻⁴", "10⁻³", "10⁻²", "10⁻¹", "10⁰", "10¹"}));
    EXPECT_EQ(logarithmicTicks(1, 1e12, 6).size(), 5U);
}

TEST(ReportAxis, LogarithmsPutDecadesAtEqualDistances) {
    const Scale scale{{1, 100}, true, 0, 200};

    EXPECT_DOUBLE_EQ(scale.pixel(1), 0);
    EXPECT_DOUBLE_EQ(scale.pixel(10), 100);
    EXPECT_DOUBLE_EQ(scale.pixel(100), 200);
}

TEST(ReportAxis, ValuesBeginAtZeroWhereThatCostsLittle) {
    EXPECT_EQ(shownSpan({30, 100}, false, true).low, 0);
    EXPECT_GT(shownSpan({90, 100}, false, true).low, 80);
}

TEST(ReportAxis, AnythingHasAWidthAndTicks) {
    const double tiny = std::numeric_limits<double>::denorm_min();
    const double nextToOne = std::nextafter(1.0, 2.0);
    for (const Span data : {Span{5, 5}, Span{0, 0}, Span{-3, -3}, Span{1, nextToOne}, Span{0, tiny},
                            Span{-1e100, 1e100}, Span{1e100, 1e100}}) {
        for (const bool roundEnds : {false, true}) {
            const Span shown = shownSpan(data, false, roundEnds);
            EXPECT_LT(shown.low, shown.high) << data.low;
            EXPECT_LE(shown.low, data.low);
            EXPECT_GE(shown.high, data.high);
            EXPECT_GE(linearTicks(shown.low, shown.high, 6).size(), 2U) << data.low;
        }
    }
    for (const Span data : {Span{5, 5}, Span{10, 10}, Span{1e-100, 1e100}, Span{21, 48}}) {
        const Span shown = shownSpan(data, true, true);
        EXPECT_LT(shown.low, shown.high) << data.low;
        EXPECT_GT(shown.low, 0);
        EXPECT_GE(logarithmicTicks(shown.low, shown.high, 6).size(), 2U) << data.low;
    }
}

TEST(ReportAxis, MarksWidenItUnlessTheDataWouldBeLost) {
    EXPECT_EQ(widened({0, 70}, 100, false).value().high, 100);
    EXPECT_EQ(widened({20, 70}, 10, false).value().low, 10);
    EXPECT_EQ(widened({0, 5}, 1e6, false), std::nullopt);
    EXPECT_EQ(widened({1, 10}, 1e9, true), std::nullopt);
    EXPECT_EQ(widened({1, 10}, 0, true), std::nullopt);
    EXPECT_EQ(widened({1, 10}, std::numeric_limits<double>::quiet_NaN(), false), std::nullopt);
}

TEST(ReportNumbers, HaveTheDigitsThatSaySomething) {
    EXPECT_EQ(readable(0), "0");
    EXPECT_EQ(readable(3), "3");
    EXPECT_EQ(readable(0.41234), "0.412");
    EXPECT_EQ(readable(12.345), "12.3");
    EXPECT_EQ(readable(1234.5), "1234");
    EXPECT_EQ(readable(1234567, "'"), "1'234'567");
    EXPECT_EQ(readable(-41234), "-41 234");
    EXPECT_EQ(readable(0.0000123), "1.23e-5");
    EXPECT_EQ(readable(1e300), "1.00e300");
    EXPECT_EQ(readable(std::numeric_limits<double>::quiet_NaN()), "none");
}

TEST(ReportNumbers, ReadBackAsTheSame) {
    for (const double value : {1.0 / 3, 1e-310, -1.7976931348623157e308, 0.1}) {
        EXPECT_EQ(std::strtod(exact(value).c_str(), nullptr), value);
    }
    EXPECT_EQ(exact(std::numeric_limits<double>::quiet_NaN()), "");
}

}  // namespace
}  // namespace cortex::profiler
