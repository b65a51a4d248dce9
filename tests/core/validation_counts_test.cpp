// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/validation.hpp"

#include "core/model_folder.hpp"

#include <string>

#include <gtest/gtest.h>

namespace cortex {
namespace {

using namespace test;

TEST(Validation, SaysOnceThatARuleIsMisspelt) {
    const std::string lamps = simplex("/l1", "Lamp") + simplex("/l2", "Lamp");
    const auto alone =
        checkSmall(simplex("/arm", "Arm", relate("tol", "/hand")) + simplex("/hand", "Welder"));
    const auto oneOfTwo = checkSmall(
        simplex("/p", "Painter", relate("outputs", "/l1") + relate("outptus", "/l2")) + lamps);
    const auto notEnough = checkSmall(simplex("/p", "Painter", relate("outptus", "/l2")) + lamps);
    const auto another = checkSmall(simplex("/arm", "Arm", relate("zzzz", "/l1")) + lamps);

    EXPECT_EQ(only(alone).rule, "unknown-rule") << alone.report.text();
    EXPECT_EQ(only(oneOfTwo).rule, "unknown-rule") << oneOfTwo.report.text();
    for (const CheckedModel* both : {&notEnough, &another}) {
        EXPECT_EQ(both->count("unknown-rule"), 1U) << both->report.text();
        EXPECT_EQ(both->count("below-min"), 1U) << both->report.text();
    }
}

TEST(Validation, NamesTheRuleThatShouldRefineTheOneThatLacksSimplexes) {
    const std::string lamps = simplex("/l1", "Lamp") + simplex("/l2", "Lamp");
    const auto related = only(checkSmall(
        simplex("/p", "Painter", relate("lights", "/l1") + relate("lights", "/l2")) + lamps));
    const auto bare = only(checkSmall(simplex("/p", "Painter") + lamps));

    EXPECT_EQ(related.rule, "below-min");
    EXPECT_TRUE(related.remedy.starts_with(
        "write refines=\"outputs\" for rule 'lights' (small-morphology.xml:36), or add "))
        << related.remedy;
    EXPECT_EQ(bare.rule, "below-min");
    EXPECT_TRUE(bare.remedy.starts_with("relate 2 with ")) << bare.remedy;
}

TEST(Validation, SuggestsWhatStandsBesideTheTargetsOfOthersOfTheType) {
    const auto finding = only(checkSmall(
        simplex("/arm1", "Arm", relate("tool", "/tools/1")) + simplex("/arm2", "Arm") +
        simplex("/a", "Welder") + simplex("/tools/1", "Welder") + simplex("/tools/2", "Welder")));

    EXPECT_EQ(finding.rule, "below-min");
    EXPECT_EQ(finding.remedy, "relate one with <relate rule=\"tool\" to=\"/tools/2\"/>");
}

// What follows from it, by the rule that `demands` refines and by its own losses, is not told
// again.
TEST(Validation, SaysOnceThatDemandsLackAndNamesTheOneThatNobodyWrites) {
    const ModelFolder folder;
    folder.copyOntology();
    const auto system = [&](const std::string& demands) {
        return check(folder.write(
            "system.xml",
            "<system name=\"test\">\n<morphology file=\"cortex-morphology.xml\"/>\n" +
                simplex("/axis", "RotaryAxisConcept") + simplex("/demand", "RotaryAxisConcept") +
                simplex("/drive", "SimulatedAxis",
                        relate("demand", "/demand") + relate("observation", "/axis")) +
                simplex("/jog", "JogController", relate("axes", "/axis") + demands) +
                "</system>\n"));
    };

    const auto finding = only(system(""));

    EXPECT_EQ(finding.rule, "below-min") << finding.message;
    EXPECT_EQ(finding.remedy, "relate one with <relate rule=\"demands\" to=\"/demand\"/>");
    EXPECT_EQ(system(relate("demands", "/demand")).report.text(), "");
}

TEST(Validation, FindsMoreThanTheMaximum) {
    const auto finding =
        only(checkSmall(simplex("/arm", "Arm", relate("tool", "/w1") + relate("tool", "/w2")) +
                        simplex("/w1", "Welder") + simplex("/w2", "Welder")));

    EXPECT_EQ(finding.rule, "above-max");
    EXPECT_EQ(finding.place.line, 5);
    EXPECT_TRUE(contains(finding.message, "takes 1 Tool, has 2"));
}

TEST(Validation, CountsRelationsOfARefiningRuleForTheOneItRefines) {
    const auto checked = checkSmall(
        simplex("/c", "BlindController",
                relate("demands", "/a1") + relate("demands", "/a2") + relate("third", "/a3")) +
        simplex("/a1", "Axis") + simplex("/a2", "Axis") + simplex("/a3", "Axis"));

    ASSERT_NE(checked.find("above-max"), nullptr) << checked.report.text();
    EXPECT_EQ(checked.find("above-max")->place.line, 6);
    EXPECT_TRUE(contains(checked.find("above-max")->message, "rule 'demands'"));
}

TEST(Validation, FindsACreatedPathThatIsTaken) {
    const auto finding = only(checkSmall(simplex("/t", "Three") + simplex("/t/axes/2", "Axis1")));

    EXPECT_EQ(finding.rule, "created-path");
    EXPECT_EQ(finding.path, "/t/axes/2");
    EXPECT_EQ(finding.place.line, 5);
    EXPECT_TRUE(contains(finding.remedy, "write type=\"Axis2\"")) << finding.remedy;
}

TEST(Validation, SaysWhyNothingMoreIsCreated) {
    const auto finding = only(checkSmall(simplex("/n", "Nest")));

    EXPECT_EQ(finding.rule, "below-min");
    EXPECT_EQ(finding.path, "/n/inner/inner/inner/inner/inner/inner/inner");
    EXPECT_EQ(finding.place.line, 3);  // of the simplex in the file that it was created for
    EXPECT_TRUE(contains(finding.message, "at most 8 levels")) << finding.message;
}

TEST(Validation, WantsAsManyUnderARuleAsUnderTheOneThatItGoesBy) {
    const std::string lifts = simplex("/a", "Lift") + simplex("/b", "Lift") +
                              simplex("/c", "Lift") + simplex("/d", "Lift");
    const std::string seen = relate("seen", "/a") + relate("seen", "/b");

    const auto fewer =
        only(checkSmall(simplex("/m", "Mover", seen + relate("moved", "/c")) + lifts));
    const auto equal = checkSmall(
        simplex("/m", "Mover", seen + relate("moved", "/c") + relate("moved", "/d")) + lifts);
    const auto more = only(
        checkSmall(simplex("/m", "Mover",
                           relate("seen", "/a") + relate("moved", "/c") + relate("moved", "/d")) +
                   lifts));
    const auto none = checkSmall(simplex("/m", "Mover", seen) + lifts);

    EXPECT_EQ(fewer.rule, "count-unequal");
    EXPECT_EQ(fewer.path, "/m");
    EXPECT_EQ(fewer.message,
              "rule 'moved' (small-morphology.xml:49) has 1, rule 'seen' has 2: there must be one "
              "for each, in the same order");
    EXPECT_TRUE(fewer.remedy.starts_with("relate one with <relate rule=\"moved\" to=\"/"));
    EXPECT_FALSE(contains(fewer.remedy, "remote")) << "an output: " << fewer.remedy;
    EXPECT_EQ(more.rule, "count-unequal");
    EXPECT_TRUE(contains(more.remedy,
                         "; if another agent has it, <relate rule=\"seen\" to=\"…\" "
                         "remote=\"true\"/>"))
        << more.remedy;
    EXPECT_TRUE(equal.report.ok()) << equal.report.text();
    EXPECT_TRUE(none.report.ok()) << none.report.text();
}

}  // namespace
}  // namespace cortex
