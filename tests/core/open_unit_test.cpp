// SPDX-License-Identifier: Apache-2.0
#include "core/xml_model.hpp"

#include <gtest/gtest.h>

// unit="*": an abstract type has an item, its children say in which unit.
namespace cortex {
namespace {

using test::finds;
using test::isValid;
using test::readTypes;
using test::XmlModel;

const std::string openItem = "<data name='x' kind='float' unit='*'/>";

std::string typeText(const std::string& attributes, const std::string& content = "") {
    return "<type " + attributes + ">" + content + "</type>\n";
}

std::string unitText(const std::string& text) { return "<data name='x' unit='" + text + "'/>"; }

TEST(OpenUnit, IsFixedByAChildForGood) {
    const std::string axis = typeText("name='P' abstract='true'", openItem);
    const std::string between = typeText("name='B' extends='P' abstract='true'");
    const XmlModel fixed =
        readTypes(axis + between + typeText("name='A' extends='B'", unitText("rad")));

    ASSERT_TRUE(isValid(fixed));
    EXPECT_EQ(fixed.data("P", "x").unit, "*");
    EXPECT_EQ(fixed.data("B", "x").unit, "*");
    EXPECT_EQ(fixed.data("A", "x").unit, "rad");
    EXPECT_TRUE(finds(readTypes(axis + typeText("name='C' extends='P'", unitText("rad")) +
                                typeText("name='A' extends='C'", unitText("m"))),
                      "unit-changed", "A", 3, "from 'rad' to 'm'"));
    EXPECT_TRUE(finds(readTypes(axis + typeText("name='C' extends='P'", unitText("rad")) +
                                typeText("name='A' extends='C' abstract='true'", unitText("*"))),
                      "unit-changed", "A", 3));
}

TEST(OpenUnit, IsOutrankedByAParentThatFixesIt) {
    const std::string types = typeText("name='P' abstract='true'", openItem) +
                              typeText("name='Rotary' extends='P'", unitText("rad")) +
                              typeText("name='Seen' extends='P' abstract='true'") +
                              typeText("name='Linear' extends='P'", unitText("m")) +
                              typeText("name='Left' extends='Rotary Seen'") +
                              typeText("name='Right' extends='Seen Rotary'");

    const XmlModel model = readTypes(types);

    ASSERT_TRUE(isValid(model));
    EXPECT_EQ(model.data("Left", "x").unit, "rad");
    EXPECT_EQ(model.data("Right", "x").unit, "rad");
    EXPECT_TRUE(finds(readTypes(types + typeText("name='A' extends='Rotary Linear'")),
                      "intersection-empty", "A", 7));
}

TEST(OpenUnit, IsForAbstractTypesAlone) {
    const std::string axis = typeText("name='P' abstract='true'", openItem);

    EXPECT_TRUE(finds(readTypes(typeText("name='A'", openItem)), "unit-open", "A", 1, "abstract"));
    EXPECT_TRUE(finds(readTypes(axis + typeText("name='A' extends='P'")), "unit-open", "A", 2,
                      "data 'x' has an open unit"));
    EXPECT_TRUE(
        finds(readTypes(typeText("name='A' role='active' abstract='true'",
                                 "<command name='go'><request name='x' kind='float' unit='*'/>"
                                 "</command>")),
              "unit-open", "A", 1, "parameter 'x'"));
    EXPECT_TRUE(finds(
        readTypes(typeText("name='A' abstract='true'", "<data name='x' kind='bool' unit='*'/>")),
        "unit-kind", "A", 1));
}

}  // namespace
}  // namespace cortex
