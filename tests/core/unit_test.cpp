// SPDX-License-Identifier: Apache-2.0
#include "types/unit.hpp"

#include <gtest/gtest.h>

namespace cortex {
namespace {

std::string canonical(const char* text) {
    std::string why;
    const auto unit = parseUnit(text, why);
    return unit ? unit->canonical : "refused: " + why;
}

Dimension dimension(const char* text) {
    std::string why;
    return parseUnit(text, why).value().dimension;
}

TEST(Unit, GivesTextsOfOneMeaningOneCanonicalText) {
    EXPECT_EQ(canonical("rad/s"), "rad/s");
    EXPECT_EQ(canonical("rad.s-1"), "rad/s");
    EXPECT_EQ(canonical("s-1.rad"), "rad/s");
    EXPECT_EQ(canonical("m.N"), "N.m");
    EXPECT_EQ(canonical("N.m"), "N.m");
    EXPECT_EQ(canonical("m/s/s"), "m/s2");
    EXPECT_EQ(canonical("/min"), "/min");
    EXPECT_EQ(canonical("1/min"), "/min");
    EXPECT_EQ(canonical("m/m"), "1");
    EXPECT_EQ(canonical("1"), "1");
    EXPECT_EQ(canonical("%"), "%");
    EXPECT_EQ(canonical("[ppm]"), "[ppm]");
    EXPECT_EQ(canonical("m/s-2"), "m.s2");
}

TEST(Unit, KeepsScalesApart) {
    EXPECT_NE(canonical("mm"), canonical("m"));
    EXPECT_NE(canonical("deg"), canonical("rad"));
    EXPECT_EQ(dimension("mm"), dimension("m"));
    EXPECT_EQ(dimension("deg/s"), dimension("rad/ms"));
    EXPECT_NE(dimension("N"), dimension("N.m"));
}

TEST(Unit, TakesAWholeSymbolBeforeAPrefix) {
    EXPECT_EQ(dimension("min"), dimension("s"));  // not milli-inch
    EXPECT_EQ(dimension("Pa"), dimension("N/m2"));
    EXPECT_EQ(dimension("cd"), dimension("kcd"));
    EXPECT_EQ(dimension("dam"), dimension("m"));
}

TEST(Unit, DerivesDimensionsOfDerivedUnits) {
    EXPECT_EQ(dimension("N"), dimension("kg.m/s2"));
    EXPECT_EQ(dimension("J"), dimension("N.m"));
    EXPECT_EQ(dimension("W"), dimension("J/s"));
    EXPECT_EQ(dimension("V"), dimension("W/A"));
    EXPECT_EQ(dimension("Ohm"), dimension("V/A"));
    EXPECT_EQ(dimension("S"), dimension("A/V"));
    EXPECT_EQ(dimension("F"), dimension("C/V"));
    EXPECT_EQ(dimension("C"), dimension("A.s"));
    EXPECT_EQ(dimension("H"), dimension("Wb/A"));
    EXPECT_EQ(dimension("Wb"), dimension("V.s"));
    EXPECT_EQ(dimension("T"), dimension("Wb/m2"));
    EXPECT_EQ(dimension("lx"), dimension("lm/m2"));
    EXPECT_EQ(dimension("Gy"), dimension("J/kg"));
    EXPECT_EQ(dimension("L"), dimension("dm3"));
}

TEST(Unit, RefusesWhatItDoesNotKnowWithTheNearest) {
    EXPECT_EQ(canonical("radians"), "refused: 'radians' is not a unit of UCUM; nearest of: rad");
    EXPECT_EQ(canonical("Nm"), "refused: 'Nm' is not a unit of UCUM; nearest of: N.m");
    EXPECT_EQ(canonical("m/sec"), "refused: unit symbol 'sec' is not known; nearest of: s");
    EXPECT_EQ(canonical("°C"), "refused: '°C' is not a unit of UCUM; nearest of: Cel");
    EXPECT_EQ(canonical("rda"), "refused: unit symbol 'rda' is not known; nearest of: rad");
}

TEST(Unit, RefusesMalformedTexts) {
    for (const char* text :
         {"", "m/", "m..s", "/", "2m", "10", "m s", "m^2", "m2.", "m0", "m10", "m-", "(m)", "kdeg",
          "m/s/quux", "m.m.m.m.m.m.m.m.m.m.m.m.m.m.m.m.m.m.m"}) {
        EXPECT_TRUE(canonical(text).starts_with("refused: "))
            << text << " gives " << canonical(text);
    }
}

TEST(Unit, DoesNotOverflowOnGreatExponents) {
    EXPECT_EQ(canonical("L9.L9.L9.L9.L9.L9.L9.L9.L9.L9"), "L90");
    EXPECT_EQ(dimension("L9.L9.L9.L9.L9.L9.L9.L9.L9.L9")[0], 270);
}

}  // namespace
}  // namespace cortex
