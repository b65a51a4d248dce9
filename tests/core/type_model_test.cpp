// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/type_model.hpp"

#include "cortex/core/error.hpp"

#include "core/model_folder.hpp"
#include "core/xml_model.hpp"

#include <gtest/gtest.h>

namespace cortex {
namespace {

using test::finds;
using test::isValid;
using test::readTypes;
using test::XmlModel;

TEST(TypeModel, GivesAChildAllThatItsParentsHave) {
    const XmlModel model = readTypes(R"(
      <type name="Axis" role="descriptive" icon="axis.svg"><data name="position" kind="float" unit="rad"/></type>
      <type name="Named"><data name="label" kind="string" capacity="16"/></type>
      <type name="Motor" extends="Axis Named"><data name="current" kind="float" unit="A"/></type>)",
                                     R"(
      <rules type="Axis"><relationship name="next" direction="input" target="Axis" max="1"/></rules>)");
    ASSERT_TRUE(isValid(model));
    const Type& motor = model.type("Motor");
    EXPECT_EQ(motor.ancestors, (std::set<std::string, std::less<>>{"Axis", "Named"}));
    ASSERT_EQ(motor.data.size(), 3U);
    EXPECT_EQ(motor.data[0].name, "current");
    EXPECT_EQ(motor.data[1].definedBy, "Named");
    EXPECT_EQ(motor.data[2].name, "position");
    EXPECT_EQ(motor.rules.size(), 1U);
    EXPECT_EQ(motor.icon, "axis.svg");
    EXPECT_TRUE(model.files.types.isA("Motor", "Named"));
    EXPECT_TRUE(model.files.types.isA("Motor", "Motor"));
    EXPECT_FALSE(model.files.types.isA("Axis", "Motor"));
    EXPECT_FALSE(model.files.types.isA("Absent", "Axis"));
    EXPECT_EQ(motor.findData("absent"), nullptr);
    EXPECT_EQ(motor.findCommand("absent"), nullptr);
}

TEST(TypeModel, NamesTheNearestTypesWhenOneIsUnknown) {
    const XmlModel model = readTypes("<type name='RotaryAxis'/>");
    try {
        model.type("RotaryAxs");
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "there is no type 'RotaryAxs'; nearest of: RotaryAxis");
    }
    EXPECT_THROW(model.type("Gripper"), Error);
}

TEST(TypeModel, LoadThrowsAllFindingsAtOnce) {
    const test::ModelFolder folder;
    const auto file = folder.write("bad.xml",
                                   "<ontology name='t'><type name='A' extends='B'/>\n"
                                   "<type name='C'><data name='x'/></type></ontology>");
    try {
        TypeModel::load(file);
        FAIL();
    } catch (const ModelError& error) {
        EXPECT_EQ(error.report().errors(), 2U);
        EXPECT_EQ(std::string{error.what()}, error.report().text());
    }
}

TEST(TypeModel, LoadReadsTheShippedFiles) {
    const TypeModel model = TypeModel::load(CORTEX_SOURCE_DIR "/ontology/cortex-morphology.xml");
    EXPECT_TRUE(model.isA("Robotiq2Finger", "Gripper"));
    EXPECT_TRUE(model.isA("Robotiq2Finger", "OneDofManipulator"));
    EXPECT_TRUE(model.declarations().contains("Active"));
}

TEST(TypeModel, RefusesATypeGivenTwice) {
    const XmlModel model = readTypes("<type name='A'/>\n<type name='A' abstract='true'/>");
    EXPECT_TRUE(finds(model, "duplicate-type", "A", 2, "first at t.xml:1"));
    EXPECT_FALSE(model.type("A").isAbstract);
}

TEST(TypeModel, RefusesUnknownParentsWithTheNearestAndGoesOn) {
    const XmlModel model = readTypes(
        "<type name='Active' role='active'/>\n"
        "<type name='A' extends='Activ'><command name='go'/></type>");
    EXPECT_TRUE(finds(model, "unknown-parent", "A", 2, "nearest of: Active"));
    EXPECT_NE(model.type("A").findCommand("go"), nullptr);
    EXPECT_TRUE(finds(readTypes("<type name='A' extends='Quux'/>"), "unknown-parent", "A", 1,
                      "include the ontology"));
}

TEST(TypeModel, RefusesAParentNamedTwice) {
    EXPECT_TRUE(finds(readTypes("<type name='P'/><type name='A' extends='P P'/>"),
                      "duplicate-parent", "A", 1));
}

TEST(TypeModel, PrintsACircleOfParentsWhole) {
    const XmlModel model = readTypes(
        "<type name='A' extends='B'/>\n<type name='B' extends='C'/>\n<type name='C' extends='A'/>\n"
        "<type name='D' extends='A'><data name='x' kind='int'/></type>");
    EXPECT_TRUE(finds(model, "parent-cycle", "C", 3, "A extends B extends C extends A"));
    EXPECT_NE(model.type("D").findData("x"), nullptr);
    EXPECT_TRUE(
        finds(readTypes("<type name='A' extends='A'/>"), "parent-cycle", "A", 1, "A extends A"));
}

TEST(TypeModel, RefusesDeepInheritance) {
    std::string types = "<type name='T0'/>";
    for (int i = 1; i < 70; ++i) {
        types +=
            "\n<type name='T" + std::to_string(i) + "' extends='T" + std::to_string(i - 1) + "'/>";
    }
    const XmlModel model = readTypes(types);
    ASSERT_FALSE(model.report.ok());
    EXPECT_EQ(model.report.findings.front().rule, "inheritance-depth");
    std::string backwards;
    for (int i = 70; i > 0; --i) {
        backwards +=
            "\n<type name='T" + std::to_string(i) + "' extends='T" + std::to_string(i - 1) + "'/>";
    }
    const XmlModel other = readTypes(backwards + "<type name='T0'/>");
    ASSERT_FALSE(other.report.ok());
    EXPECT_EQ(other.report.findings.front().rule, "inheritance-depth");
}

TEST(TypeModel, RefusesTooManyParents) {
    std::string types, parents;
    for (int i = 0; i < 65; ++i) {
        types += "<type name='P" + std::to_string(i) + "'/>";
        parents += "P" + std::to_string(i) + " ";
    }
    EXPECT_TRUE(finds(readTypes(types + "<type name='A' extends='" + parents + "'/>"),
                      "inheritance-depth", "A", 1));
}

TEST(TypeModel, RefusesWhatIsNoName) {
    EXPECT_TRUE(finds(readTypes("<type name='1st'/>"), "name", "1st", 1));
    EXPECT_TRUE(finds(readTypes("<type name='" + std::string(65, 'a') + "'/>"), "name",
                      std::string(64, 'a'), 1));
    EXPECT_TRUE(
        finds(readTypes("<type name='A'><data name='a b' kind='int'/></type>"), "name", "A", 1));
    EXPECT_TRUE(finds(readTypes("<type name='A' role='active'><command name='c'>"
                                "<request name='' kind='int'/></command></type>"),
                      "name", "A", 1));
}

// Roles

TEST(TypeModel, LetsAChildFixTheRoleThatIsOpen) {
    const XmlModel model = readTypes(R"(
      <type name="Any"/> <type name="Concept" extends="Any" role="descriptive"/>
      <type name="Seen" extends="Concept" role="observation"/> <type name="Seen2" extends="Seen Concept"/>
      <type name="Doer" extends="Any" role="active"/> <type name="Doer2" extends="Any Doer"/>)");
    ASSERT_TRUE(isValid(model));
    EXPECT_EQ(model.type("Any").role, Role::Descriptive);
    EXPECT_EQ(model.type("Seen2").role, Role::Observation);
    EXPECT_EQ(model.type("Doer2").role, Role::Active);
    EXPECT_TRUE(model.type("Doer2").active());
}

TEST(TypeModel, RefusesAChangedRole) {
    EXPECT_TRUE(finds(
        readTypes(
            "<type name='P' role='descriptive'/>\n<type name='A' extends='P' role='active'/>"),
        "role-changed", "A", 2, "from descriptive to active"));
    EXPECT_TRUE(finds(readTypes("<type name='P' role='observation'/>\n"
                                "<type name='A' extends='P' role='modification'/>"),
                      "role-changed", "A", 2));
    EXPECT_TRUE(finds(readTypes("<type name='P' role='observation'/>\n"
                                "<type name='A' extends='P' role='descriptive'/>"),
                      "role-changed", "A", 2));
    EXPECT_TRUE(finds(
        readTypes(
            "<type name='P' role='active'/>\n<type name='A' extends='P' role='observation'/>"),
        "role-changed", "A", 2));
}

TEST(TypeModel, RefusesParentsWhoseRolesExcludeEachOther) {
    EXPECT_TRUE(
        finds(readTypes("<type name='P' role='observation'/><type name='Q' role='modification'/>\n"
                        "<type name='A' extends='P Q'/>"),
              "role-conflict", "A", 2, "observation by 'P' and modification by 'Q'"));
    EXPECT_TRUE(
        finds(readTypes("<type name='P' role='active'/><type name='Q' role='descriptive'/>\n"
                        "<type name='A' extends='P Q'/>"),
              "role-conflict", "A", 2));
    EXPECT_TRUE(
        finds(readTypes("<type name='P' role='descriptive'/><type name='Q' role='active'/>\n"
                        "<type name='A' extends='P Q'/>"),
              "role-conflict", "A", 2));
}

TEST(TypeModel, NeedsSafeValuesInAModification) {
    EXPECT_TRUE(finds(
        readTypes("<type name='A' role='modification'>\n<data name='x' kind='float'/></type>"),
        "safe-missing", "A", 2, "'x'"));
    EXPECT_TRUE(finds(readTypes("<type name='P'><data name='x' kind='float'/></type>\n"
                                "<type name='A' extends='P' role='modification'/>\n"
                                "<type name='B' extends='A'/>"),
                      "safe-missing", "A", 2));
    EXPECT_TRUE(isValid(
        readTypes("<type name='A' role='modification'><data name='x' kind='float' safe='hold'/>"
                  "<data name='c' kind='float' constant='true'/></type>")));
}

// Attributes of the type itself

TEST(TypeModel, InheritsFlagsAndTakesTheStricter) {
    const XmlModel model = readTypes(R"(
      <type name="P" writers="many" measures="true" onLeaseLost="hold" transitionTimeout="20" icon="p"/>
      <type name="Q" onLeaseLost="shutdown" transitionTimeout="5"/>
      <type name="A" extends="P Q"/>
      <type name="B" extends="A" writers="one" measures="false" onLeaseLost="continue" transitionTimeout="3" icon="b"
            since="2.0" replaces="Old" version="1.1"/>)");
    ASSERT_TRUE(isValid(model));
    const Type& a = model.type("A");
    EXPECT_TRUE(a.manyWriters && a.measures);
    EXPECT_EQ(a.onLeaseLost, OnLeaseLost::Shutdown);
    EXPECT_EQ(a.transitionTimeout, 5);
    EXPECT_EQ(a.icon, "p");
    const Type& b = model.type("B");
    EXPECT_FALSE(b.manyWriters || b.measures);
    EXPECT_EQ(b.onLeaseLost, OnLeaseLost::Continue);
    EXPECT_EQ(b.transitionTimeout, 3);
    EXPECT_EQ(b.icon + b.since + b.replaces + b.version, "b2.0Old1.1");
    EXPECT_EQ(a.version, "");
}

TEST(TypeModel, RefusesMoreWritersThanInherited) {
    EXPECT_TRUE(finds(
        readTypes("<type name='P' writers='one'/>\n<type name='A' extends='P' writers='many'/>"),
        "writers-changed", "A", 2));
    const XmlModel both = readTypes(
        "<type name='P' writers='one'/><type name='Q' writers='many'/>"
        "<type name='A' extends='P Q'/><type name='B' extends='Q P'/>");
    ASSERT_TRUE(isValid(both));
    EXPECT_FALSE(both.type("A").manyWriters || both.type("B").manyWriters);
}

TEST(TypeModel, RefusesATransitionTimeoutThatIsNoTime) {
    EXPECT_TRUE(
        finds(readTypes("<type name='A' transitionTimeout='0'/>"), "transition-timeout", "A", 1));
    EXPECT_TRUE(
        finds(readTypes("<type name='A' transitionTimeout='-1'/>"), "transition-timeout", "A", 1));
}

TEST(TypeModel, RefusesLongDescriptions) {
    const std::string text(5000, 'x');
    EXPECT_TRUE(
        finds(readTypes("<type name='A' description='" + text + "'/>"), "text-length", "A", 1));
    EXPECT_TRUE(finds(readTypes("<type name='A'><data name='x' kind='int'><description>" + text +
                                "</description></data></type>"),
                      "text-length", "A", 1));
    EXPECT_TRUE(finds(readTypes("<type name='A'><data name='x' kind='int' format='" +
                                text.substr(0, 40) + "'/></type>"),
                      "text-length", "A", 1));
}

TEST(TypeModel, BuildsFromDeclarationsInCode) {
    TypeDeclaration base, child;
    base.name = "Axis";
    base.data.emplace_back();
    base.data[0].name = "position";
    base.data[0].unit = "rad";
    base.data[0].min = std::int64_t{-3};
    base.data[0].max = 3.5;
    base.rules.emplace_back();
    base.rules[0].name = "next";
    base.rules[0].target = "Axis";
    child.name = "Short";
    child.parents = {"Axis"};
    child.data.emplace_back();
    child.data[0].name = "position";
    child.data[0].max = 1.0;
    child.data[0].hasDefault = true;
    child.data[0].initial = std::vector<std::int64_t>{1};
    child.rules.emplace_back();
    child.rules[0].name = "next";
    child.rules[0].max = 2;
    Report report;
    const TypeModel model = TypeModel::build({base, child}, report);
    ASSERT_TRUE(report.findings.empty()) << report.text();
    const DataItem& item = *model.at("Short").findData("position");
    EXPECT_EQ(item.min, Number{-3.0});
    EXPECT_EQ(item.max, Number{1.0});
    EXPECT_EQ(item.initial, Value{std::vector<double>{1}});
    EXPECT_EQ(item.unit, "rad");
    EXPECT_EQ(model.at("Short").findRule("next")->max, 2U);
    EXPECT_EQ(model.at("Short").findRule("next")->target, "Axis");
}

TEST(TypeModel, BoundsWhatInheritanceMultiplies) {
    std::string types = "<type name='Base'>";
    for (int i = 0; i < 2000; ++i) {
        types += "<data name='x" + std::to_string(i) + "' kind='string' length='64'/>";
    }
    types += "</type>";
    for (int i = 0; i < 3000; ++i)
        types += "\n<type name='T" + std::to_string(i) + "' extends='Base'/>";
    const XmlModel model = readTypes(types);
    ASSERT_EQ(model.report.findings.size(), 1U);
    EXPECT_EQ(model.report.findings.front().rule, "model-size");
}

TEST(TypeModel, RefusesTooManyItemsOfOneType) {
    std::string types = "<type name='A'>";
    for (int i = 0; i < 4097; ++i) types += "<data name='x" + std::to_string(i) + "' kind='bool'/>";
    EXPECT_TRUE(finds(readTypes(types + "</type>"), "model-size", "A", 1, "more than 4096"));
}

}  // namespace
}  // namespace cortex
