// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/validation.hpp"

#include "core/model_folder.hpp"
#include "core/xml_model.hpp"

#include <limits>
#include <regex>
#include <tuple>

#include <gtest/gtest.h>

namespace cortex {
namespace {

using namespace test;

TEST(Validation, FindsNothingInAGoodSystem) {
    const auto checked = checkSmall(
        simplex("/observed", "Axis", set("note", "8 octets")) + simplex("/demanded", "Axis") +
        simplex("/controller", "Controller",
                relate("axes", "/observed") + relate("demands", "/demanded") + set("gain", "10")) +
        simplex("/device", "Device",
                relate("demand", "/demanded") + relate("observation", "/observed")) +
        simplex("/arm", "Arm", relate("tool", "/hand")) + simplex("/hand", "TwoFinger") +
        simplex("/three", "Three"));

    EXPECT_EQ(checked.report.text(), "");
}

TEST(Validation, NamesRulePlaceAndRemedyOfWhatIsMissing) {
    const auto checked = checkSmall(simplex("/arm", "Arm") + simplex("/hand", "Welder"));

    const Finding finding = only(checked);

    EXPECT_EQ(finding.severity, Severity::Error);
    EXPECT_EQ(finding.rule, "below-min");
    EXPECT_EQ(finding.path, "/arm");
    EXPECT_EQ(finding.place.text(), "system.xml:3");
    EXPECT_EQ(finding.message, "rule 'tool' (small-morphology.xml:23) needs 1 Tool, has 0");
    EXPECT_EQ(finding.remedy, "relate one with <relate rule=\"tool\" to=\"/hand\"/>");
}

TEST(Validation, NamesTheRulesPlaceForATreeBuiltInCode) {
    SimplexTree tree{smallTypes()};
    tree.add("/arm", "Arm");

    const Report report = validate(tree);

    ASSERT_EQ(report.findings.size(), 1U) << report.text();
    EXPECT_TRUE(report.findings[0].place.file.ends_with("small-morphology.xml"));
    EXPECT_EQ(report.findings[0].place.line, 23);
    EXPECT_EQ(report.findings[0].message, "rule 'tool' needs 1 Tool, has 0");
    EXPECT_EQ(report.findings[0].remedy,
              "add <simplex path=\"/arm/tool\" type=\"TwoFinger\"/> and relate one with "
              "<relate rule=\"tool\" to=\"/arm/tool\"/>");
}

TEST(Validation, ReportsEveryFindingNotTheFirst) {
    const auto checked =
        checkSmall(simplex("/arm", "Arm") +
                   simplex("/controller", "Controller", relate("axis", "/a") + set("gain", "11")) +
                   simplex("/a", "Axsi") + simplex("/b", "Axis", set("position", "-4")));

    EXPECT_EQ(checked.report.findings.size(), 5U) << checked.report.text();
    for (const char* rule : {"below-min", "unknown-rule", "unknown-type"}) {
        EXPECT_EQ(checked.count(rule), 1U) << rule;
    }
    EXPECT_EQ(checked.count("setting-range"), 2U);
}

TEST(Validation, DoesNotChangeTheTree) {
    SimplexTree tree{smallTypes()};
    tree.add("/three", "Three");

    const Report report = validate(tree);

    EXPECT_EQ(report.findings.size(), 2U) << report.text();
    EXPECT_EQ(tree.simplexes().size(), 1U);
}

TEST(Validation, FindsAnUnknownRule) {
    const auto near =
        checkSmall(simplex("/c", "Controller", relate("axs", "/a")) + simplex("/a", "Axis"));
    const auto far =
        checkSmall(simplex("/c", "Controller", relate("zzzzz", "/a")) + simplex("/a", "Axis"));
    const auto none =
        checkSmall(simplex("/l", "Lamp", relate("axes", "/a")) + simplex("/a", "Axis"));

    EXPECT_EQ(only(near).rule, "unknown-rule");
    EXPECT_EQ(only(near).place.line, 4);
    EXPECT_TRUE(contains(only(near).remedy, "write <relate rule=\"axes\" to=\"/a\"/>"));
    EXPECT_TRUE(contains(only(far).remedy, "rules of Controller: axes, demands"));
    EXPECT_EQ(only(none).remedy, "remove it: type Lamp has no rules");
}

TEST(Validation, FindsAnUnknownTarget) {
    const auto input = only(checkSmall(simplex("/c", "Controller", relate("axes", "/axsi")) +
                                       simplex("/axis", "Axis") + simplex("/other", "Axis")));
    const auto output = only(
        checkSmall(simplex("/s", "Switch", relate("lamps", "/lamp")) + simplex("/lamps", "Lamp")));

    EXPECT_EQ(input.rule, "unknown-path");
    EXPECT_EQ(input.place.line, 4);
    EXPECT_EQ(input.remedy,
              "write <relate rule=\"axes\" to=\"/axis\"/>; if another agent has it, "
              "<relate rule=\"axes\" to=\"/axsi\" remote=\"true\"/>");
    const std::string far =
        checkSmall(simplex("/c", "Controller",
                           relate("axes", "/elsewhere/of/9") + relate("demands", "/own")) +
                   simplex("/own", "Axis"))
            .report.text();
    EXPECT_TRUE(contains(far,
                         "if another agent has it, write <relate rule=\"axes\" "
                         "to=\"/elsewhere/of/9\" remote=\"true\"/>; if this one should, add a "
                         "simplex with this path"))
        << "never what it writes itself: " << far;
    EXPECT_EQ(output.rule, "unknown-path");
    EXPECT_EQ(output.remedy, "write <relate rule=\"lamps\" to=\"/lamps\"/>");
}

TEST(Validation, FindsATargetOfTheWrongType) {
    const auto finding = only(checkSmall(simplex("/arm", "Arm", relate("tool", "/axis")) +
                                         simplex("/axis", "Axis") + simplex("/w", "Welder")));

    EXPECT_EQ(finding.rule, "target-type");
    EXPECT_EQ(finding.place.line, 4);
    EXPECT_TRUE(contains(finding.message, "takes a Tool; /axis is an Axis"));
    EXPECT_EQ(finding.remedy, "write <relate rule=\"tool\" to=\"/w\"/>");
}

TEST(Validation, FindsATargetRelatedTwiceUnderOneRule) {
    const auto twice =
        checkSmall(simplex("/c", "Controller", relate("axes", "/a") + relate("axes", "/a")) +
                   simplex("/a", "Axis"));
    const auto underTwoRules =
        checkSmall(simplex("/d", "Device", relate("demand", "/a") + relate("observation", "/a")) +
                   simplex("/a", "Axis"));

    EXPECT_EQ(only(twice).rule, "target-twice");
    EXPECT_EQ(only(twice).place.line, 5);
    EXPECT_EQ(only(twice).remedy, "remove this <relate>, or correct its target");
    EXPECT_EQ(underTwoRules.count("target-twice"), 0U);
}

TEST(Validation, FindsAnInstanceOfAnAbstractType) {
    const auto finding = only(checkSmall(simplex("/t", "Tool")));

    EXPECT_EQ(finding.rule, "abstract-type");
    EXPECT_EQ(finding.place.line, 3);
    EXPECT_EQ(finding.remedy, "write type=\"TwoFinger\"; there are TwoFinger, Welder");
}

TEST(Validation, FindsAMalformedPathAndMendsIt) {
    const auto finding = only(checkSmall(simplex("arm//l br/", "Axis")));

    EXPECT_EQ(finding.rule, "malformed-path");
    EXPECT_EQ(finding.place.line, 3);
    EXPECT_EQ(finding.remedy, "write path=\"/arm/l-br\"");
}

TEST(Validation, RefusesOnePathForTwoSystemsOfATree) {
    auto checked = checkSmall(simplex("/a", "Axis"));
    Report report;

    checked.tree->add(SystemDescription{checked.tree->description()}, nullptr, report);

    ASSERT_EQ(report.findings.size(), 1U) << report.text();
    EXPECT_EQ(report.findings[0].rule, "duplicate-path");
    EXPECT_TRUE(contains(report.findings[0].remedy, "write path=\"/a-2\""));
}

struct SettingCase {
    const char* item;
    const char* value;
    const char* rule;
    const char* remedy;
};

class SettingOfAnAxis : public testing::TestWithParam<SettingCase> {};

TEST_P(SettingOfAnAxis, IsChecked) {
    const SettingCase& each = GetParam();

    const Finding finding = only(checkSmall(simplex("/axis", "Axis", set(each.item, each.value))));

    EXPECT_EQ(finding.rule, each.rule) << finding.message;
    EXPECT_EQ(finding.path, "/axis");
    EXPECT_EQ(finding.place.line, 4);
    EXPECT_TRUE(contains(finding.remedy, each.remedy)) << finding.remedy;
}

INSTANTIATE_TEST_SUITE_P(
    Validation, SettingOfAnAxis,
    testing::Values(
        SettingCase{"positon", "1", "unknown-item", "write <set data=\"position\" value=\"1\"/>"},
        SettingCase{"position", "far", "setting-kind",
                    "write <set data=\"position\" value=\"0\"/>"},
        SettingCase{"position", "nan", "setting-finite", "<set data=\"position\" value=\"0\"/>"},
        SettingCase{"position", "-inf", "setting-finite", "<set data=\"position\" value=\"0\"/>"},
        SettingCase{"position", "3.5", "setting-range", "<set data=\"position\" value=\"3\"/>"},
        SettingCase{"position", "-3.5", "setting-range", "<set data=\"position\" value=\"-3\"/>"},
        SettingCase{"position", "1 2", "setting-length", "<set data=\"position\" value=\"0\"/>"},
        SettingCase{"mode", "1.5", "setting-kind", "write one of the labels"},
        SettingCase{"mode", "2", "setting-range", "<set data=\"mode\" value=\"0\"/>"},
        SettingCase{"direction", "0 0", "setting-length", "value=\"0 0 1\"/>"},
        SettingCase{"direction", "0 0 x", "setting-kind", "value=\"0 0 1\"/>"},
        SettingCase{"position", "0,5", "setting-kind", "value=\"0.5\"/>"},
        SettingCase{"direction", "0,3 0 0,26", "setting-kind", "value=\"0.3 0 0.26\"/>"},
        SettingCase{"direction", "0,0,1", "setting-length", "value=\"0 0 1\"/>"},
        SettingCase{"direction", "0 2 -2", "setting-range", "value=\"0 1 -1\"/>"},
        SettingCase{"note", "nine octs", "setting-length", "value=\"nine oct\"/>"}));

TEST(Validation, SaysHowManyValuesASettingNeedsAndHas) {
    const auto scalar = checkSmall(simplex("/a", "Axis", set("position", "1 2")));
    const auto array = checkSmall(simplex("/a", "Axis", set("direction", "0 0")));

    EXPECT_EQ(only(scalar).message, "item 'position' is float: expected 1 value, found 2");
    EXPECT_EQ(only(array).message,
              "item 'direction' is float array of 3: expected 3 values, found 2");
}

TEST(Validation, CutsATextThatIsTooLongAtACharacter) {
    const Finding finding = only(checkSmall(simplex("/a", "Axis", set("note", "1234567\u00e9"))));

    EXPECT_EQ(finding.rule, "setting-length");
    EXPECT_EQ(finding.remedy, "write <set data=\"note\" value=\"1234567\"/>");
}

TEST(Validation, RefusesToSetWhatTheFrameworkWrites) {
    const auto checked =
        checkSmall(simplex("/c", "Controller",
                           set("state", "2") + set("faultCode", "1") + set("taskTime", "1")) +
                   simplex("/a", "Agent", set("progress", "1")));

    EXPECT_EQ(checked.count("setting-framework"), 4U) << checked.report.text();
    EXPECT_EQ(checked.report.findings.size(), 4U);
    EXPECT_EQ(checked.find("setting-framework")->remedy, "remove this <set>");
}

TEST(Validation, SaysThatAMeasuredItemIsWrittenByItsSimplex) {
    SimplexTree tree{
        test::readTypes(
            "<type name='Pump'><data name='spent' kind='float' measured='true'/></type>")
            .files.types};
    tree.add("/a", "Pump").set("spent", 1.0);

    const Report report = validate(tree);

    ASSERT_FALSE(report.ok());
    EXPECT_EQ(report.findings.back().rule, "setting-framework");
    EXPECT_TRUE(contains(report.findings.back().message,
                         ") is measured: its simplex writes it, so no file gives it a value"))
        << report.text();
}

TEST(Validation, ChecksSettingsMadeInCode) {
    SimplexTree tree{smallTypes()};
    tree.add("/a", "Axis").set("position", true);
    tree.add("/b", "Axis").set("position", std::numeric_limits<double>::quiet_NaN());
    tree.add("/c", "Axis").set("direction", 1.0);

    const Report report = validate(tree);

    ASSERT_EQ(report.findings.size(), 3U) << report.text();
    EXPECT_EQ(report.findings[0].rule, "setting-kind");
    EXPECT_TRUE(contains(report.findings[0].message, "is a float, set is a bool"));
    EXPECT_EQ(report.findings[1].rule, "setting-finite");
    EXPECT_EQ(report.findings[2].rule, "setting-length");
    EXPECT_TRUE(
        report.findings[2].message.ends_with("is float array of 3: expected 3 values, found 1"))
        << report.findings[2].message;
}

TEST(Validation, TakesRemoteSimplexesAsInputsOnly) {
    const auto output =
        only(checkSmall(simplex("/s", "Switch", relate("lamps", "/far", "remote=\"true\""))));
    const auto local =
        checkSmall(simplex("/c", "Controller", relate("axes", "/a", "remote=\"true\"")) +
                   simplex("/a", "Axis"));
    const auto noAxis = only(checkSmall(
        simplex("/c", "Controller", relate("axes", "/far", "remote=\"true\" type=\"Switch\""))));
    const auto malformed =
        only(checkSmall(simplex("/c", "Controller", relate("axes", "far", "remote=\"true\""))));
    const auto differing =
        only(checkSmall(simplex("/s", "Switch",
                                relate("before", "/far", "remote=\"true\"") +
                                    relate("watched", "/far", "remote=\"true\""))));

    EXPECT_EQ(output.rule, "remote-output");
    EXPECT_EQ(output.place.line, 4);
    EXPECT_TRUE(contains(output.remedy, "a rule with direction=\"input\" and target=\"Lamp\""))
        << output.remedy;
    EXPECT_TRUE(local.report.findings.empty()) << local.report.text();
    EXPECT_EQ(noAxis.rule, "target-type");
    EXPECT_EQ(malformed.rule, "malformed-path");
    EXPECT_EQ(differing.rule, "remote-types");
}

TEST(Validation, ChecksTheRatesOfASystemMadeInCode) {
    SystemDescription system;
    for (const auto& [path, every, phase] : {std::tuple{"/a", 0, -1},
                                             {"/b", 2, 2},
                                             {"/c", 2, -2},
                                             {"/d", 2, 1},
                                             {"/e", 1'000'000, 0},
                                             {"/f", 1'000'001, 0}}) {
        system.simplexes.push_back({path, "Switch", every, phase, {}, {}, {}});
    }
    system.simplexes.push_back({"/lamp", "Lamp", 2, 0, {}, {}, {}});
    SimplexTree tree{smallTypes()};
    Report report;
    tree.add(system, nullptr, report);

    report.append(validate(tree));

    ASSERT_EQ(report.findings.size(), 5U) << report.text();
    EXPECT_EQ(report.findings[0].rule, "every-range");
    EXPECT_EQ(report.findings[1].rule, "phase-range");
    EXPECT_EQ(report.findings[2].rule, "phase-range");
    EXPECT_EQ(report.findings[3].rule, "every-range");
    EXPECT_EQ(report.findings[3].path, "/f");
    EXPECT_EQ(report.findings[4].rule, "every-without-task");
    EXPECT_EQ(report.findings[4].path, "/lamp");
}

TEST(Validation, WantsTheTypeOfTheAgentItself) {
    Report report;
    TypeDeclaration type;
    type.name = "Axis";
    const SimplexTree tree{TypeModel::build({type}, report)};

    report = validate(tree);

    ASSERT_EQ(report.findings.size(), 1U) << report.text();
    EXPECT_EQ(report.findings[0].rule, "agent-type");
    EXPECT_TRUE(contains(report.findings[0].remedy, "base.xml"));
}

TEST(Validation, KeepsThePathOfTheClusterFree) {
    const auto taken = only(checkSmall("<cluster name=\"robot\"/>\n" + simplex("/robot", "Axis")));
    const auto own = checkSmall("<cluster name=\"robot\"/>\n" + simplex("/robot", "Agent"));

    EXPECT_EQ(taken.rule, "cluster-path");
    EXPECT_EQ(taken.place.line, 4);
    EXPECT_TRUE(contains(taken.message, "system.xml:3")) << taken.message;
    EXPECT_TRUE(own.report.ok()) << own.report.text();
}

TEST(Validation, HasEveryFindingExplained) {
    const std::string explained = textOf(CORTEX_SOURCE_DIR "/docs/findings.md");
    const std::regex constant{"\\[\\] = \"([a-z-]+)\""};
    int count = 0;
    for (const char* header : {"findings.hpp", "system_findings.hpp"}) {
        std::string text =
            textOf(std::string{CORTEX_SOURCE_DIR "/core/internal/cortex/core/"} + header);
        for (std::smatch match; std::regex_search(text, match, constant); ++count) {
            EXPECT_TRUE(contains(explained, "| `" + match[1].str() + "` |")) << match[1];
            text = match.suffix();
        }
    }
    EXPECT_GT(count, 80);
}

TEST(Validation, EndsWithAModelThatIsWrongThroughout) {
    SimplexTree tree{smallTypes()};
    auto& all = tree.add("/all", "Controller");
    for (int n = 0; n < 20'000; ++n) {
        const std::string path = "/" + std::to_string(n);
        auto& controller = tree.add(path, "Controller");
        tree.relate(controller, "axs", all);
        tree.relate(all, "demands", controller);
    }

    const Report report = validate(tree);

    EXPECT_EQ(report.errors(), 20'000U + 20'000U);
}

TEST(Validation, EndsWithATreeOfManySimplexesInALine) {
    SimplexTree tree{smallTypes()};
    Simplex* before = &tree.add("/0", "Switch");
    for (int n = 1; n < 20'000; ++n) {
        Simplex& next = tree.add("/" + std::to_string(n), "Switch");
        tree.relate(next, "before", *before);
        before = &next;
    }

    EXPECT_TRUE(validate(tree).ok());
}

}  // namespace
}  // namespace cortex
