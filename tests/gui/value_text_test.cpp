// SPDX-License-Identifier: Apache-2.0
#include "model/value_text.hpp"

#include "support/small_structure.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace gui;

std::string shown(double number, double resolution = 0, const std::string& format = {}) {
    DataItem each = item("x", std::vector<double>{0});
    each.resolution = resolution;
    each.format = format;
    return numberText(each, number).toStdString();
}

TEST(NumberText, FollowsFormatThenResolutionThenSixDigits) {
    EXPECT_EQ(shown(1.23456789, 0, "%.3f"), "1.235");
    EXPECT_EQ(shown(12.3456, 0.01), "12.35");
    EXPECT_EQ(shown(12.3456, 0.5), "12.3");
    EXPECT_EQ(shown(3.14159265), "3.14159");
    EXPECT_EQ(shown(1234567.0), "1234567");
    EXPECT_EQ(shown(0.9), "0.9");
    EXPECT_EQ(shown(0), "0");
}

TEST(NumberText, HasAPrintedMinusAndNoneOnWhatRoundsToZero) {
    EXPECT_EQ(shown(-0.5), "−0.5");
    EXPECT_EQ(shown(-0.0001, 0.01), "0.00");
}

TEST(NumberText, HasExponentsOnlyForTheVeryLargeAndTheVerySmall) {
    EXPECT_EQ(shown(2.5e7), "2.5×10⁷");
    EXPECT_EQ(shown(-2.5e-5), "−2.5×10⁻⁵");
    EXPECT_EQ(shown(0.0001), "0.0001");
}

TEST(NumberText, NamesWhatIsNoNumber) {
    EXPECT_EQ(shown(std::numeric_limits<double>::quiet_NaN()), "not a number");
    EXPECT_EQ(shown(std::numeric_limits<double>::infinity()), "∞");
    EXPECT_EQ(shown(-std::numeric_limits<double>::infinity()), "−∞");
}

TEST(ValueText, NamesLabelsAndSaysWhereThereIsNone) {
    DataItem mode = item("mode", std::vector<std::int64_t>{0});
    mode.labels = {{3, "AtLimit"}};
    EXPECT_EQ(valueText(mode, std::vector<std::int64_t>{3}).toStdString(), "AtLimit (3)");
    EXPECT_EQ(valueText(mode, std::vector<std::int64_t>{7}).toStdString(), "7 (no label)");
}

TEST(ValueText, ShowsTheFirstThreeOfAnArray) {
    const std::vector<double> numbers{1, 2, 3, 4};
    EXPECT_EQ(valueText(item("x", numbers), numbers).toStdString(), "1  2  3  …");
}

TEST(ValueText, ShowsNoControlCharacters) {
    const std::vector<std::string> text{"a\nb\x1b[31mc"};
    EXPECT_EQ(valueText(item("x", text), text).toStdString(), "a\uFFFDb\uFFFD[31mc");
}

TEST(UnitText, IsTypeset) {
    EXPECT_EQ(unitText("N.m").toStdString(), "N·m");
    EXPECT_EQ(unitText("m/s2").toStdString(), "m/s²");
    EXPECT_EQ(unitText("Cel").toStdString(), "°C");
    EXPECT_EQ(unitText("us").toStdString(), "µs");
    EXPECT_EQ(unitText("s-1").toStdString(), "s⁻¹");
    EXPECT_EQ(unitText("").toStdString(), "");
}

TEST(AgeText, GrowsCoarser) {
    EXPECT_EQ(ageText(0.006).toStdString(), "6 ms");
    EXPECT_EQ(ageText(2.14).toStdString(), "2.1 s");
    EXPECT_EQ(ageText(725).toStdString(), "12 min");
    EXPECT_EQ(ageText(11100).toStdString(), "3 h 05 min");
}

}  // namespace
}  // namespace cortex::test
