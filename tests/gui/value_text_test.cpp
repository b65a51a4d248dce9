// SPDX-License-Identifier: Apache-2.0
#include "model/value_text.hpp"

#include "model/plain_text.hpp"
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

TEST(EnteredValue, SaysInPlainWordsWhatIsExpected) {
    const auto why = [](const DataItem& of, const char* text) {
        QString reason;
        EXPECT_FALSE(enteredValue(of, text, reason)) << text;
        return wrongText(of.name, reason).toStdString();
    };
    const std::vector<std::int64_t> whole{0};
    EXPECT_EQ(why(item("count", whole), "1.5"), "count: whole number expected");
    EXPECT_EQ(why(item("count", whole), "9223372036854775808"),
              "count: expected a whole number of 64 bit, found '9223372036854775808'");
    EXPECT_EQ(why(item("gain", std::vector{0.0}), "fast"), "gain: number expected");
    EXPECT_EQ(why(item("on", std::vector<bool>{false}), "1"), "on: true or false expected");
    DataItem mode = item("mode", whole);
    mode.labels = {{0, "Standby"}, {1, "Homing"}, {2, "Velocity"}, {3, "Torque"}};
    EXPECT_EQ(why(mode, "x"), "mode: 'x' is no label; try Standby, Homing or Velocity");
    EXPECT_EQ(why(mode, "Torqu"), "mode: 'Torqu' is no label; try Torque");
    EXPECT_EQ(why(mode, "7"), "mode: '7' is no label; try Standby, Homing or Velocity");
    mode.max = std::int64_t{9};
    QString reason;
    EXPECT_TRUE(enteredValue(mode, "7", reason)) << "an open enumeration has other numbers, too";
    EXPECT_EQ(why(mode, "10"), "mode is out of the range * to 9");
}

TEST(ValueText, ShowsTheFirstThreeOfAnArray) {
    const std::vector<double> numbers{1, 2, 3, 4};
    EXPECT_EQ(valueText(item("x", numbers), numbers).toStdString(), "1  2  3  …");
}

TEST(ValueText, ShowsNoControlCharacters) {
    const std::vector<std::string> text{"a\nb\x1b[31mc"};
    EXPECT_EQ(valueText(item("x", text), text).toStdString(), "a\uFFFDb\uFFFD[31mc");
}

TEST(ValueText, DoesNotLetALabelTurnWhatStandsBesideIt) {
    DataItem mode = item("mode", std::vector<std::int64_t>{0});
    mode.labels = {{1, "a\u202Eb"}, {2, "Jog"}, {3, "\u05D0\u05D1"}};
    const auto number = [](std::int64_t one) { return Value{std::vector{one}}; };
    EXPECT_EQ(valueText(mode, number(1)).toStdString(), "a\uFFFDb (1)");
    EXPECT_EQ(valueText(mode, number(3)).toStdString(), "\u2068\u05D0\u05D1\u2069 (3)");
    EXPECT_EQ(entryText(mode, number(1)).toStdString(), "1") << "it cannot be read in a field";
    EXPECT_EQ(entryText(mode, number(2)).toStdString(), "Jog");
    EXPECT_EQ(entryText(mode, number(3)).toStdString(), "\u05D0\u05D1");
}

TEST(IsolatedText, StaysInItsPlaceAmongOtherWords) {
    EXPECT_EQ(isolatedText("0.5").toStdString(), "0.5");
    EXPECT_EQ(isolatedText("a\u202Eb\n").toStdString(), "a\uFFFDb\uFFFD");
    EXPECT_EQ(isolatedText("\u05D0").toStdString(), "\u2068\u05D0\u2069");
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
