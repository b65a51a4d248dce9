// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agent.hpp"
#include "cortex/core/agreement.hpp"
#include "cortex/core/error.hpp"
#include "cortex/core/type_description.hpp"
#include "cortex/core/validation.hpp"

#include "core/model_folder.hpp"
#include "core/xml_model.hpp"

#include <array>
#include <chrono>
#include <string>

#include <gtest/gtest.h>

// Constant numbers that must be greater than another one of the same simplex: above.
namespace cortex {
namespace {

using test::CheckedModel;
using test::finds;
using test::isValid;
using test::ModelFolder;
using test::readTypes;
using test::set;
using test::simplex;
using test::XmlModel;

const std::string seconds = "kind='float' unit='s' constant='true' ";

// A line each: the type (1), `loss`, which must be above `wait` (2), and `wait` (3).
std::string device(const std::string& loss, const std::string& wait,
                   const std::string& attributes = "", const std::string& above = "wait") {
    return "<type name='P' " + attributes + ">\n<data name='loss' above='" + above + "' " + loss +
           "/>\n<data name='wait' " + wait + "/></type>\n";
}

std::string good() { return device(seconds + "default='0.05'", seconds + "default='0.02'"); }

TEST(AnItemAboveAnother, IsReadInheritedAndToldInTheCanonicalText) {
    const XmlModel model =
        readTypes(good() + "<type name='A' extends='P'><data name='loss' default='2'/></type>");

    ASSERT_TRUE(isValid(model));
    EXPECT_EQ(model.data("A", "loss").above, "wait");
    EXPECT_NE(canonicalText(model.type("A")).find("data loss\n above \"wait\"\n constant"),
              std::string::npos)
        << canonicalText(model.type("A"));
}

TEST(AnItemAboveAnother, NamesOneOfItsType) {
    const auto of = [](const std::string& name) {
        return readTypes(device(seconds + "default='2'", seconds + "default='1'", "", name));
    };
    EXPECT_TRUE(finds(of("wiat"), "above", "P", 2, "nearest of: wait"));
    EXPECT_TRUE(finds(of("zzzzzz"), "above", "P", 2, "name the item"));
    EXPECT_TRUE(finds(of("loss"), "above", "P", 2, "which is itself"));
}

TEST(AnItemAboveAnother, IsASingleConstantNumberAsTheOtherIs) {
    const auto pair = [](const std::string& loss, const std::string& wait) {
        return readTypes(device("constant='true' " + loss, wait));
    };
    EXPECT_TRUE(isValid(pair("kind='int' default='2'", "kind='int' constant='true'")));
    EXPECT_TRUE(finds(pair("kind='int' default='2'", "kind='float' constant='true'"), "above", "P",
                      2, "is int, and that one float"));
    EXPECT_TRUE(finds(pair("kind='string' default='b'", "kind='string' constant='true'"), "above",
                      "P", 2, "kind=\"int\" for both"));
    EXPECT_TRUE(finds(pair("kind='int' default='2'", "kind='int' length='2' constant='true'"),
                      "above", "P", 2, "single numbers"));
    EXPECT_TRUE(finds(pair("kind='int' default='2 2' length='2'", "kind='int' constant='true'"),
                      "above", "P", 2, "single numbers"));
    EXPECT_TRUE(
        finds(pair("kind='int' default='2'", "kind='int'"), "above", "P", 2, "'wait' is not"));
    EXPECT_TRUE(finds(readTypes(device("kind='int' default='2'", "kind='int' constant='true'")),
                      "above", "P", 2, "'loss' is not constant"));
}

TEST(AnItemAboveAnother, HasItsUnit) {
    const auto units = [](const std::string& loss, const std::string& wait,
                          const std::string& attributes = "") {
        const std::string number = "kind='float' constant='true' ";
        return device(number + "default='2' " + loss, number + "default='1' " + wait, attributes);
    };
    EXPECT_TRUE(isValid(readTypes(units("unit='m.s-1'", "unit='m/s'"))));
    EXPECT_TRUE(isValid(readTypes(units("", ""))));
    EXPECT_TRUE(finds(readTypes(units("unit='s'", "unit='ms'")), "above", "P", 2, "has the unit"));
    EXPECT_TRUE(finds(readTypes(units("unit='s'", "")), "above", "P", 2, "has no unit"));

    const std::string open = units("unit='*'", "unit='*'", "abstract='true'");
    const auto child = [&](const std::string& wait) {
        return readTypes(open + "<type name='A' extends='P'><data name='loss' unit='s'/>" +
                         "<data name='wait' unit='" + wait + "'/></type>");
    };
    EXPECT_TRUE(isValid(child("s")));
    EXPECT_TRUE(finds(child("min"), "above", "A", 4, "'min'"));
}

TEST(AnItemAboveAnother, IsNotAboveItselfByWayOfOthers) {
    const std::string number = "kind='int' constant='true' default=";
    const std::string types = "<type name='P'>\n<data name='a' above='b' " + number +
                              "'3'/>\n<data name='b' above='c' " + number +
                              "'2'/>\n<data name='c' " + number + "'1' ";
    EXPECT_TRUE(isValid(readTypes(types + "/></type>")));

    const XmlModel loop = readTypes(types + "above='b'/></type>");

    ASSERT_EQ(loop.report.findings.size(), 2U) << loop.text();
    for (const Finding& each : loop.report.findings) {
        EXPECT_EQ(each.rule, "above");
        EXPECT_NE(each.message.find("itself"), std::string::npos) << loop.text();
    }
    EXPECT_EQ(loop.report.findings[0].place.line, 3) << "'a' leads into the loop and is not of it";
}

TEST(AnItemAboveAnother, KeepsItsItemInChildrenAndFromSeveralParents) {
    const std::string other = "<type name='Q'>" + ("<data name='loss' above='rest' " + seconds) +
                              "default='0.05'/><data name='rest' " + seconds + "/></type>\n";
    EXPECT_TRUE(finds(readTypes(good() + "<type name='A' extends='P'>\n<data name='rest' " +
                                seconds + "/>\n<data name='loss' above='rest'/></type>"),
                      "above", "A", 6, "leave above out"));
    EXPECT_TRUE(finds(readTypes(good() + other + "<type name='A' extends='P Q'/>"),
                      "intersection-empty", "A", 5, "above"));
    const std::string plain = "<type name='Q'><data name='loss' " + seconds + "/></type>\n";
    const XmlModel joined = readTypes(good() + plain + "<type name='A' extends='Q P'/>");
    ASSERT_TRUE(isValid(joined));
    EXPECT_EQ(joined.data("A", "loss").above, "wait");
}

TEST(AnItemAboveAnother, IsNoAttributeOfParameters) {
    EXPECT_TRUE(finds(readTypes("<type name='A' role='active'><command name='c'>\n"
                                "<request name='x' kind='int' above='y'/></command></type>"),
                      "unknown-attribute", "A", 2));

    TypeDeclaration type;
    type.name = "A";
    type.role = Role::Active;
    type.commands.emplace_back().name = "c";
    DataItem& parameter = type.commands[0].request.emplace_back();
    parameter.name = "x";
    parameter.above = "y";
    Report report;
    TypeModel::build({type}, report);
    ASSERT_EQ(report.findings.size(), 1U) << report.text();
    EXPECT_EQ(report.findings[0].rule, "parameter-attribute");
}

// Defaults

TEST(ADefaultAboveAnother, IsGreater) {
    EXPECT_TRUE(isValid(readTypes(good())));
    EXPECT_TRUE(finds(readTypes(device(seconds + "default='0.02'", seconds + "default='0.02'")),
                      "default-above", "P", 2,
                      "default 0.02 s, which is not above that of 'wait', 0.02 s"));
    EXPECT_TRUE(finds(readTypes(device(seconds + "default='0.01'", seconds + "default='0.02'")),
                      "default-above", "P", 2, "write a default above 0.02 s"));
    EXPECT_TRUE(finds(readTypes(device(seconds, seconds)), "default-above", "P", 2, "0 s"));
}

TEST(ADefaultAboveAnother, IsComparedToTheLastDigit) {
    const auto pair = [](const std::string& loss) {
        return readTypes(device("kind='int' constant='true' default='" + loss + "'",
                                "kind='int' constant='true' default='9007199254740992'"));
    };
    EXPECT_TRUE(isValid(pair("9007199254740993")));
    EXPECT_TRUE(finds(pair("9007199254740992"), "default-above", "P", 2));
}

TEST(ADefaultAboveAnother, IsThatOfTheChildInAChild) {
    const auto child = [](const std::string& items) {
        return readTypes(good() + "<type name='A' extends='P'>\n" + items + "</type>");
    };
    EXPECT_TRUE(isValid(child("<data name='loss' default='0.03'/>")));
    EXPECT_TRUE(isValid(child("<data name='loss' default='3'/>\n<data name='wait' default='2'/>")));
    EXPECT_TRUE(finds(child("<data name='loss' default='0.01'/>"), "default-above", "A", 5));
    EXPECT_TRUE(finds(child("<data name='wait' default='1'/>"), "default-above", "A", 5,
                      "0.05 s, which is not above that of 'wait', 1 s"));
}

TEST(ADefaultAboveAnother, IsToldOnceForTheTypeThatStatesIt) {
    EXPECT_TRUE(finds(readTypes(device(seconds + "default='1'", seconds + "default='1'") +
                                "<type name='A' extends='P'/><type name='B' extends='A'/>"),
                      "default-above", "P", 2));
}

TEST(ADefaultAboveAnother, MayBeLeftByAnAbstractTypeToItsChildren) {
    const auto types = [](const std::string& loss, const std::string& child) {
        return readTypes(device(seconds + loss, seconds + "default='1'", "abstract='true'") +
                         "<type name='A' extends='P'>\n" + child + "</type>");
    };
    EXPECT_TRUE(isValid(types("", "<data name='loss' default='2'/>")));
    EXPECT_TRUE(finds(types("", ""), "default-above", "A", 4, "0 s"));
    EXPECT_TRUE(
        finds(types("default='0.5'", "<data name='loss' default='2'/>"), "default-above", "P", 2));
}

// Other agents

TEST(AnItemAboveAnother, IsToldWholeToOtherAgents) {
    const XmlModel model = readTypes(good());
    const std::array told{describe(model.type("P"))};
    Report report;

    const TypeModel theirs = modelOf(told, report);

    EXPECT_EQ(report.text(), "");
    EXPECT_EQ(theirs.at("P").findData("loss")->above, "wait");
    EXPECT_EQ(describe(theirs.at("P")), told[0]);
}

TEST(AnItemAboveAnother, KeepsItsHashWithAnAgentThatDoesNotKnowTheAttribute) {
    const XmlModel model = readTypes(good());
    Type older = model.type("P");
    DataItem& item = older.data.front();
    item.unknown["above"] = item.above;  // as such an agent keeps it
    item.above.clear();

    EXPECT_EQ(typeHash(older), typeHash(model.type("P")));
    EXPECT_EQ(describe(older), describe(model.type("P")));
}

TEST(AnItemAboveAnother, IsADifferenceToATypeWithoutIt) {
    const XmlModel with = readTypes(good());
    Type without = with.type("P");
    without.data.front().above.clear();

    const auto found = compare(with.type("P"), without);

    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].text(), "P loss: difference, ours has above=\"wait\", theirs nothing");
}

// Systems

const std::string systemTypes =
    R"(<type name="Activity" abstract="true" role="active"/>
<type name="Agent" extends="Activity"/>
<type name="Device">
<data name="loss" kind="float" unit="s" constant="true" min="0" max="1" default="0.05" above="wait"/>
<data name="wait" kind="float" unit="s" constant="true" min="0.001" default="0.02"/>
</type>
)";

// The line of the file: the <simplex> in 2, what stands in it from 3 on.
CheckedModel system(const std::string& settings) {
    const ModelFolder folder;
    folder.write("types.xml", "<ontology name=\"t\">\n" + systemTypes + "</ontology>");
    return test::check(
        folder.write("system.xml", "<system name=\"s\"><ontology file=\"types.xml\"/>\n" +
                                       simplex("/bus", "Device", settings) + "</system>\n"));
}

Finding only(const std::string& settings) { return test::only(system(settings)); }

TEST(ASettingAboveAnother, IsGreater) {
    EXPECT_EQ(system("").report.text(), "");
    EXPECT_EQ(system(set("loss", "0.021")).report.text(), "");
    EXPECT_EQ(system(set("wait", "0.049")).report.text(), "");
    EXPECT_EQ(system(set("loss", "0.9") + set("wait", "0.8")).report.text(), "");
    for (const std::string& wrong : {set("loss", "0.02"), set("loss", "0.01"), set("wait", "0.05"),
                                     set("wait", "3"), set("wait", "0.8") + set("loss", "0.8")}) {
        const CheckedModel checked = system(wrong);
        EXPECT_EQ(checked.report.findings.size(), 1U) << wrong << checked.report.text();
        EXPECT_EQ(checked.count("setting-above"), 1U) << wrong;
    }
}

TEST(ASettingAboveAnother, IsNamedWithBothValuesTheirPlacesAndTheRemedy) {
    const Finding finding = only(set("loss", "0.02"));

    EXPECT_EQ(finding.severity, Severity::Error);
    EXPECT_EQ(finding.path, "/bus");
    EXPECT_EQ(finding.rule, "setting-above");
    EXPECT_EQ(finding.place.text(), "system.xml:3");
    EXPECT_EQ(finding.message,
              "item 'loss' is 0.02 s (set, system.xml:3), which is not above item 'wait', 0.02 s "
              "(by default, types.xml:6)");
    EXPECT_EQ(finding.remedy,
              "write <set data=\"loss\" value=\"…\"/> with a value above 0.02 s, or "
              "<set data=\"wait\" value=\"…\"/> with a value below 0.02 s");
}

TEST(ASettingAboveAnother, IsNamedAtTheSetOfTheItemThatIsTooSmallWhereBothAreSet) {
    EXPECT_EQ(only(set("wait", "0.5")).place.text(), "system.xml:3");
    EXPECT_EQ(only(set("wait", "0.5") + set("loss", "0.4")).place.text(), "system.xml:4");
}

TEST(ASettingAboveAnother, HasNoRemedyThatARangeForbids) {
    EXPECT_EQ(only(set("wait", "1")).remedy,
              "write <set data=\"wait\" value=\"…\"/> with a value below 0.05 s");
    EXPECT_EQ(only(set("loss", "0.001")).remedy,
              "write <set data=\"loss\" value=\"…\"/> with a value above 0.02 s");
    EXPECT_EQ(only(set("loss", "0") + set("wait", "2")).remedy, "set both anew, or neither");
}

TEST(ASettingAboveAnother, IsJudgedOnlyWhereBothValuesAreGoodByThemselves) {
    EXPECT_EQ(only(set("loss", "-1")).rule, "setting-range");
    EXPECT_EQ(only(set("loss", "inf")).rule, "setting-finite");
    EXPECT_EQ(only(set("wait", "soon")).rule, "setting-kind");
    EXPECT_EQ(only(set("wait", "0")).rule, "setting-range");
}

// Types of a system built in code.
TypeModel deviceTypes() {
    XmlModel read = readTypes(systemTypes);
    EXPECT_TRUE(isValid(read));
    return std::move(read.files.types);
}

TEST(ASettingAboveAnother, IsJudgedOfATreeBuiltInCode) {
    SimplexTree tree{deviceTypes()};
    Simplex& bus = tree.add("/bus", "Device");
    bus.set("loss", std::vector{0.04, 0.03});
    const Report badLength = validate(tree);
    EXPECT_EQ(badLength.findings.size(), 1U) << badLength.text();
    bus.set("loss", 0.01);

    const Report report = validate(tree);

    ASSERT_EQ(report.findings.size(), 1U) << report.text();
    EXPECT_EQ(report.findings[0].rule, "setting-above");
    EXPECT_NE(report.findings[0].message.find("0.01 s (set), "), std::string::npos)
        << report.text();
}

TEST(ASettingAboveAnother, IsJudgedWhenAnAgentStarts) {
    SimplexTree wrong{deviceTypes()}, right{deviceTypes()};
    wrong.add("/bus", "Device").set("loss", 0.01);
    right.add("/bus", "Device").set("loss", 0.03);

    EXPECT_NO_THROW((AgentRuntime{"a", right, {}}));
    try {
        AgentRuntime agent{"a", wrong, {}};
        FAIL();
    } catch (const ModelError& error) {
        ASSERT_EQ(error.report().findings.size(), 1U) << error.report().text();
        EXPECT_EQ(error.report().findings[0].rule, "setting-above");
    }
}

TEST(ASettingAboveAnother, IsNotComparedWhereTheTypeIsWrong) {
    Report report;
    XmlModel read =
        readTypes("<type name='Agent' role='active'/>" +
                  device("kind='int' constant='true' default='2'", "kind='float' constant='true'"));
    ASSERT_EQ(read.report.findings.size(), 1U);
    SimplexTree tree{std::move(read.files.types)};
    tree.add("/p", "P").set("loss", 1);

    EXPECT_EQ(validate(tree).text(), "");
}

TEST(AnItemAboveAnother, IsFoundWrongInALoopOfAsManyAsATypeMayHave) {
    std::string items;
    constexpr int length = 4096;
    for (int i = 0; i < length; ++i) {
        items += "<data name='i" + std::to_string(i) + "' kind='int' constant='true' default='" +
                 std::to_string(length - i) + "' above='i" + std::to_string((i + 1) % length) +
                 "'/>";
    }
    const XmlModel loop = readTypes("<type name='P'>" + items + "</type>");

    EXPECT_EQ(loop.report.findings.size(), static_cast<std::size_t>(length));
}

}  // namespace
}  // namespace cortex
