// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agreement.hpp"

#include "core/xml_model.hpp"

#include <string>

#include <gtest/gtest.h>

// Items that are the change per second of another: derivativeOf, safe="stop", limits that agree.
namespace cortex {
namespace {

using test::finds;
using test::isValid;
using test::readTypes;
using test::XmlModel;

// A position and what `velocity` says of its derivative.
XmlModel axis(const std::string& velocity, const std::string& position = "unit='rad'") {
    return readTypes("<type name='A'><data name='p' kind='float' " + position +
                     "/>\n<data name='v' kind='float' derivativeOf='p' " + velocity + "/></type>");
}

TEST(ADerivative, IsReadMergedAndToldInTheCanonicalText) {
    const XmlModel model = readTypes(
        "<type name='P'><data name='p' kind='float' unit='m'/><data name='v' kind='float' "
        "unit='m/s' derivativeOf='p'/></type>\n"
        "<type name='A' extends='P'><data name='v' max='2'/></type>");
    ASSERT_TRUE(isValid(model));
    EXPECT_EQ(model.data("A", "v").derivativeOf, "p");
    EXPECT_NE(canonicalText(model.type("A")).find("derivativeOf p"), std::string::npos)
        << canonicalText(model.type("A"));
}

TEST(ADerivative, HasTheUnitOfItsItemPerSecond) {
    EXPECT_TRUE(isValid(axis("unit='rad/s'")));
    EXPECT_TRUE(isValid(axis("unit='m2/s'", "unit='m2'")));
    EXPECT_TRUE(isValid(axis("unit='m/s2'", "unit='m/s'")));
    EXPECT_TRUE(isValid(axis("unit='/s'", "unit='1'")));
    EXPECT_TRUE(isValid(axis("", "")));
    EXPECT_TRUE(finds(axis("unit='rad/s2'"), "derivative", "A", 2, "write unit=\"rad/s\""));
    EXPECT_TRUE(finds(axis("unit='deg/s'"), "derivative", "A", 2, "that one has 'rad'"));
    EXPECT_TRUE(finds(axis("unit='rad/s'", ""), "derivative", "A", 2, "state the unit of both"));
    EXPECT_TRUE(finds(axis(""), "derivative", "A", 2, "write unit=\"rad/s\""));
}

TEST(ADerivative, MayHaveAnOpenUnitUntilAChildFixesBoth) {
    const std::string open =
        "<type name='P' abstract='true'><data name='p' kind='float' unit='*'/>"
        "<data name='v' kind='float' unit='*' derivativeOf='p'/></type>\n";
    EXPECT_TRUE(isValid(readTypes(open + "<type name='A' extends='P'><data name='p' unit='rad'/>"
                                         "<data name='v' unit='rad/s'/></type>")));
    EXPECT_TRUE(finds(readTypes(open + "<type name='A' extends='P'><data name='p' unit='rad'/>"
                                       "<data name='v' unit='m/s'/></type>"),
                      "derivative", "A", 2, "rad/s"));
}

TEST(ADerivative, NamesAnotherFloatOfItsLength) {
    const auto of = [](const std::string& first, const std::string& name) {
        return readTypes("<type name='A'><data name='position' " + first +
                         "/>\n<data name='v' kind='float' derivativeOf='" + name + "'/></type>");
    };
    EXPECT_TRUE(finds(of("kind='float'", "positon"), "derivative", "A", 2, "position"));
    EXPECT_TRUE(finds(of("kind='int'", "position"), "derivative", "A", 2, "not both are float"));
    EXPECT_TRUE(
        finds(of("kind='float' length='3'", "position"), "derivative", "A", 2, "one length"));
    EXPECT_TRUE(finds(of("kind='float'", "v"), "derivative", "A", 2, "itself"));
}

TEST(ADerivative, IsNotItsOwnByWayOfOthers) {
    const XmlModel model = readTypes(
        "<type name='A'><data name='p' kind='float' derivativeOf='v'/>\n"
        "<data name='v' kind='float' derivativeOf='p'/></type>");
    EXPECT_EQ(model.report.findings.size(), 2U) << model.text();
    EXPECT_EQ(model.report.findings.front().rule, "derivative");
}

TEST(ADerivative, KeepsItsItemInChildrenAndFromSeveralParents) {
    const std::string parent =
        "<type name='P'><data name='p' kind='float'/><data name='q' kind='float'/>"
        "<data name='v' kind='float' derivativeOf='p'/></type>";
    EXPECT_TRUE(finds(
        readTypes(parent + "<type name='A' extends='P'>\n<data name='v' derivativeOf='q'/></type>"),
        "derivative", "A", 2, "leave derivativeOf out"));
    EXPECT_TRUE(finds(readTypes(parent + "<type name='Q'><data name='q' kind='float'/>"
                                         "<data name='v' kind='float' derivativeOf='q'/></type>\n"
                                         "<type name='A' extends='P Q'/>"),
                      "intersection-empty", "A", 2, "derivativeOf"));
}

TEST(ADerivative, IsNoAttributeOfParameters) {
    EXPECT_EQ(readTypes("<type name='A' role='active'><command name='c'>"
                        "<request name='x' kind='float' derivativeOf='y'/></command></type>")
                  .report.findings.front()
                  .rule,
              "unknown-attribute");
}

TEST(LimitsOfADerivative, AreStatedOnceOrAlike) {
    EXPECT_TRUE(isValid(axis("max='2'", "rate='2'")));
    EXPECT_TRUE(isValid(axis("max='2'", "")));
    EXPECT_TRUE(isValid(axis("", "rate='2'")));
    EXPECT_TRUE(finds(axis("max='2'", "rate='3'"), "limit-pair", "A", 2, "give both one number"));
    EXPECT_TRUE(finds(readTypes("<type name='P'><data name='p' kind='float' rate='2'/>"
                                "<data name='v' kind='float' derivativeOf='p' max='2'/></type>\n"
                                "<type name='A' extends='P'><data name='p' rate='1'/></type>"),
                      "limit-pair", "A", 2, "max='2'"));
}

TEST(WhatIsSafeAsAStop, IsAnItemWithItsDerivative) {
    EXPECT_TRUE(isValid(axis("safe='stop'", "safe='stop'")));
    EXPECT_TRUE(finds(axis("safe='0'", "safe='stop'"), "stop-pair", "A", 1, "no derivative"));
    EXPECT_TRUE(finds(axis("safe='stop'", "safe='hold'"), "stop-pair", "A", 2, "is not"));
    EXPECT_TRUE(finds(axis("safe='stop' min='1' max='2'", "safe='stop'"), "stop-pair", "A", 2,
                      "leaves 0 out"));
}

TEST(WhatIsSafeAsAStop, NeedsARateWhereItGoesOn) {
    EXPECT_TRUE(isValid(axis("safe='stop' rate='5'", "safe='stop' rate='2'")));
    EXPECT_TRUE(finds(axis("safe='stop' rate='5'", "safe='stop'"), "stop-rate", "A", 1, "'v'"));
}

TEST(WhatIsSafeAsAStop, EndsWithTheFirstDerivative) {
    const auto third = [](const std::string& safe) {
        return readTypes(
            "<type name='A'><data name='p' kind='float' safe='stop'/>"
            "<data name='v' kind='float' derivativeOf='p' safe='stop'/>\n"
            "<data name='a' kind='float' derivativeOf='v' safe='" +
            safe + "'/></type>");
    };
    EXPECT_TRUE(isValid(third("0")));
    EXPECT_FALSE(third("stop").report.ok());
    EXPECT_EQ(third("stop").report.findings.front().rule, "stop-pair");
}

TEST(WhatIsSafeAsAStop, IsAWordOfItsOwnForTextsToo) {
    EXPECT_TRUE(
        finds(readTypes("<type name='A'>\n<data name='x' kind='string' safe='stop'/></type>"),
              "stop-pair", "A", 2));
}

}  // namespace
}  // namespace cortex
