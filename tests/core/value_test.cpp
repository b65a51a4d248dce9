// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/value.hpp"

#include "cortex/core/labelled_value.hpp"

#include <clocale>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace cortex {
namespace {

TEST(Value, KnowsItsKindAndLength) {
    EXPECT_EQ(kindOf(Value{std::vector<std::int64_t>{1, 2}}), Kind::Int);
    EXPECT_EQ(kindOf(Value{std::vector<double>{}}), Kind::Float);
    EXPECT_EQ(kindOf(Value{std::vector<bool>{true}}), Kind::Bool);
    EXPECT_EQ(kindOf(Value{std::vector<std::string>{"a"}}), Kind::String);
    EXPECT_EQ(lengthOf(Value{std::vector<std::int64_t>{1, 2}}), 2U);
}

TEST(GivenValue, IsAValueAVectorOrOneElement) {
    const auto of = [](const GivenValue& given) -> Value { return given; };
    const bool on = true;
    const char* const text = "x";

    EXPECT_EQ(of(0.5), Value{std::vector{0.5}});
    EXPECT_EQ(of(0.5F), Value{std::vector{0.5}});
    EXPECT_EQ(of(3), Value{std::vector{std::int64_t{3}}});
    EXPECT_EQ(of(3U), Value{std::vector{std::int64_t{3}}});
    EXPECT_EQ(of(on), Value{std::vector<bool>{true}});
    EXPECT_EQ(of(text), Value{std::vector{std::string{"x"}}});
    EXPECT_EQ(of("x"), of(std::string{"x"}));
    EXPECT_EQ(of(std::string_view{"x"}), of("x"));
    EXPECT_EQ(of(std::vector{1.0, 2.0}), (Value{std::vector{1.0, 2.0}}));
    EXPECT_EQ(of(Value{std::vector{1.0}}), Value{std::vector{1.0}});
}

TEST(Value, NamesEachKindAsInXml) {
    for (const Kind kind : {Kind::Int, Kind::Float, Kind::Bool, Kind::String}) {
        EXPECT_EQ(kindFromName(name(kind)), kind);
    }
    EXPECT_FALSE(kindFromName("double"));
}

TEST(Value, ReadsOnlyWholeNumbersAsInt) {
    EXPECT_EQ(toInt("42"), 42);
    EXPECT_EQ(toInt("+42"), 42);
    EXPECT_EQ(toInt("-9223372036854775808"), std::numeric_limits<std::int64_t>::min());
    for (const char* text :
         {"", " 1", "1 ", "1.0", "1e3", "0x10", "9223372036854775808", "+-1", "+"}) {
        EXPECT_FALSE(toInt(text)) << text;
    }
}

TEST(Value, ReadsOnlyFiniteNumbersAsFloat) {
    EXPECT_EQ(toFloat("1.5"), 1.5);
    EXPECT_EQ(toFloat("-1e-3"), -1e-3);
    EXPECT_EQ(toFloat("+7"), 7.0);
    for (const char* text : {"", "nan", "NaN", "inf", "-inf", "infinity", "1e999", "0x1p3", "1,5",
                             "1 2", "1.5f", " 1"}) {
        EXPECT_FALSE(toFloat(text)) << text;
    }
}

TEST(Value, ReadsOnlyTrueAndFalseAsBool) {
    EXPECT_EQ(toBool("true"), true);
    EXPECT_EQ(toBool("false"), false);
    for (const char* text : {"", "1", "True", "yes"}) EXPECT_FALSE(toBool(text)) << text;
}

TEST(Value, WritesTheShortestTextThatReadsBackEqual) {
    EXPECT_EQ(toText(0.1), "0.1");
    EXPECT_EQ(toText(1e22), "1e+22");
    EXPECT_EQ(toText(std::int64_t{-5}), "-5");
    EXPECT_EQ(toText(Number{2.5}), "2.5");
    std::mt19937_64 random{7};
    for (int i = 0; i < 20'000; ++i) {
        double number = 0;
        const std::uint64_t bits = random();
        static_assert(sizeof(bits) == sizeof(number));
        std::memcpy(&number, &bits, sizeof(number));
        if (!std::isfinite(number)) continue;
        EXPECT_EQ(toFloat(toText(number)), number);
    }
}

TEST(Value, ReadsAndWritesNumbersTheSameInEveryLocale) {
    const std::string before = std::setlocale(LC_ALL, nullptr);
    if (std::setlocale(LC_ALL, "de_DE.UTF-8")) {
        char text[8];
        std::snprintf(text, sizeof text, "%.1f", 1.5);
        EXPECT_STREQ(text, "1,5");  // the locale is really in force
    }
    EXPECT_EQ(toText(1.5), "1.5");
    EXPECT_EQ(toText(1234567.0), "1234567");
    EXPECT_EQ(toFloat("1.5"), 1.5);
    EXPECT_FALSE(toFloat("1,5"));
    std::setlocale(LC_ALL, before.c_str());
}

TEST(Value, ReadsArraysSeparatedByBlanks) {
    std::string why;
    const auto value = parseValue(Kind::Float, 3, " 1 2.5\t-3\n", why);
    ASSERT_TRUE(value) << why;
    EXPECT_EQ(*value, (Value{std::vector<double>{1, 2.5, -3}}));
    EXPECT_EQ(toText(*value), "1 2.5 -3");
    EXPECT_EQ(parseValue(Kind::Bool, 2, "true false", why),
              (Value{std::vector<bool>{true, false}}));
}

TEST(Value, SaysWhatItExpectedAndWhatItFound) {
    std::string why;
    EXPECT_FALSE(parseValue(Kind::Float, 3, "1 2", why));
    EXPECT_EQ(why, "expected 3 values, found 2");
    EXPECT_FALSE(parseValue(Kind::Int, 1, "1.5", why));
    EXPECT_EQ(why, "expected a whole number, found '1.5'");
    EXPECT_FALSE(parseValue(Kind::Int, 1, "9223372036854775808", why));
    EXPECT_EQ(why, "expected a whole number of 64 bit, found '9223372036854775808'");
    EXPECT_FALSE(parseValue(Kind::Int, 1, "", why));
    EXPECT_EQ(why, "expected 1 value, found 0");
    EXPECT_FALSE(parseValue(Kind::Float, 1, "nan", why));
    EXPECT_EQ(why, "expected a finite number, found 'nan'");
    EXPECT_FALSE(parseValue(Kind::Bool, 1, "1", why));
    EXPECT_EQ(why, "expected true or false, found '1'");
}

TEST(Value, TakesTheWholeTextAsOneString) {
    std::string why;
    const auto value = parseValue(Kind::String, 1, " \"quoted\" and more ", why);
    ASSERT_TRUE(value);
    EXPECT_EQ(std::get<std::vector<std::string>>(*value).front(), " \"quoted\" and more ");
    EXPECT_EQ(toText(*value), " \"quoted\" and more ");
}

TEST(Value, TakesNoTextThatWouldEndElsewhereOrIsNone) {
    std::string why;
    EXPECT_FALSE(parseValue(Kind::String, 1, {"a\0b", 3}, why));
    EXPECT_EQ(why, "the text has the octet 0");
    EXPECT_FALSE(parseValue(Kind::String, 1, "\xff", why));
    EXPECT_EQ(why, "the text is not UTF-8");
    DataItem item;
    item.kind = Kind::String;
    const auto text = [](std::string one) { return Value{std::vector{std::move(one)}}; };
    EXPECT_EQ(valueError(item, text({"a\0b", 3})), "has the octet 0");
    EXPECT_EQ(valueError(item, text("\xff")), "is not UTF-8");
    EXPECT_EQ(valueError(item, text("ab")), "");
}

TEST(Value, QuotesElementsOfStringArraysWhereBlanksWouldDivideThem) {
    const Value value{std::vector<std::string>{"plain", "two words", "", "a \"b\" \\c"}};
    const std::string text = toText(value);
    EXPECT_EQ(text, R"(plain "two words" "" "a \"b\" \\c")");
    std::string why;
    EXPECT_EQ(parseValue(Kind::String, 4, text, why), value) << why;
}

TEST(Value, RefusesStringArraysWithMisplacedQuotes) {
    std::string why;
    for (const char* text : {"\"open", "a\"b c", "\"a\"b c"}) {
        EXPECT_FALSE(parseValue(Kind::String, 2, text, why)) << text;
        EXPECT_EQ(why, "a double quote does not begin or end an element");
    }
    EXPECT_FALSE(parseValue(Kind::String, 2, "one", why));
    EXPECT_EQ(why, "expected 2 values, found 1");
}

TEST(OutsideText, SaysHowAValueIsOutOfTheRangeOfItsItem) {
    DataItem ranged;
    ranged.min = -1.0;
    ranged.max = 2.0;
    const auto floats = [](std::vector<double> list) { return Value{std::move(list)}; };
    EXPECT_EQ(outsideText(ranged, floats({-1, 2})), "");
    EXPECT_EQ(outsideText(ranged, floats({0, 2.5})), "above 2");
    EXPECT_EQ(outsideText(ranged, floats({-1.5})), "below -1");
    EXPECT_EQ(outsideText(ranged, floats({std::numeric_limits<double>::quiet_NaN()})), "");

    DataItem labelled;
    labelled.kind = Kind::Int;
    labelled.labels = {{0, "Off"}, {5, "On"}};
    const auto ints = [](std::int64_t number) { return Value{std::vector{number}}; };
    EXPECT_TRUE(isClosed(labelled));
    EXPECT_EQ(outsideText(labelled, ints(5)), "");
    EXPECT_EQ(outsideText(labelled, ints(1)), "none of its labels");
    labelled.max = std::int64_t{9};
    EXPECT_FALSE(isClosed(labelled));
    EXPECT_EQ(outsideText(labelled, ints(1)), "");
    EXPECT_EQ(outsideText(labelled, ints(10)), "above 9");
}

}  // namespace
}  // namespace cortex
