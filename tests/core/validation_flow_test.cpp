// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/make_structure.hpp"
#include "cortex/core/validation.hpp"

#include "core/model_folder.hpp"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

namespace cortex {
namespace {

using namespace test;

TEST(Validation, PrintsAWholeLoopAndDelaysWhatIsObserved) {
    const auto finding = only(
        checkSmall(simplex("/a", "Controller", relate("axes", "/y") + relate("demands", "/x")) +
                   simplex("/b", "Controller", relate("axes", "/x") + relate("demands", "/y")) +
                   simplex("/x", "Axis") + simplex("/y", "Axis")));

    EXPECT_EQ(finding.rule, "loop");
    EXPECT_EQ(finding.path, "/a");
    EXPECT_EQ(finding.place.line, 8);
    EXPECT_TRUE(contains(finding.message, "/a -> /x -> /b -> /y -> /a")) << finding.message;
    EXPECT_EQ(finding.remedy, "write <relate rule=\"axes\" to=\"/x\" delayed=\"true\"/> in /b");
}

TEST(Validation, FindsEveryLoop) {
    const auto checked = checkSmall(simplex("/a", "Switch", relate("before", "/b")) +
                                    simplex("/b", "Switch", relate("before", "/a")) +
                                    simplex("/c", "Switch", relate("before", "/c")) +
                                    simplex("/d", "Switch", relate("before", "/a")));

    EXPECT_EQ(checked.count("loop"), 2U) << checked.report.text();
    EXPECT_TRUE(contains(checked.report.text(), "/a -> /b -> /a"));
    EXPECT_TRUE(contains(checked.report.text(), "/c -> /c"));
}

TEST(Validation, TakesALoopWithADelayedRelationship) {
    const auto checked =
        checkSmall(simplex("/a", "Switch", relate("before", "/b", "delayed=\"true\"")) +
                   simplex("/b", "Switch", relate("before", "/a")));

    EXPECT_TRUE(checked.report.ok()) << checked.report.text();
}

TEST(Validation, WantsASafeValueForEveryItemOfAModification) {
    const auto demanded =
        checkSmall(simplex("/s", "Switch", relate("lamps", "/l")) + simplex("/l", "Lamp"));
    const auto observed = checkSmall(
        simplex("/s", "Switch", relate("lamps", "/l", "delayed=\"true\"")) + simplex("/l", "Lamp"));

    EXPECT_EQ(only(demanded).rule, "safe-needed");
    EXPECT_EQ(only(demanded).path, "/l");
    EXPECT_TRUE(contains(only(demanded).message, "'on' of type Lamp has no safe value"));
    EXPECT_TRUE(contains(only(demanded).remedy, "say for 'on' (small.xml:"));
    EXPECT_FALSE(contains(only(demanded).remedy, "false")) << "nobody here knows what is safe";
    EXPECT_TRUE(observed.report.ok()) << observed.report.text();
}

TEST(Validation, WantsACounterpartForWhatIsSafeAsObserved) {
    const auto without = only(checkSmall(simplex("/c", "BlindController", relate("demands", "/a")) +
                                         simplex("/a", "Axis")));
    const auto empty = only(
        checkSmall(simplex("/c", "Controller", relate("demands", "/a")) + simplex("/a", "Axis")));

    EXPECT_EQ(without.rule, "observed-counterpart");
    EXPECT_EQ(without.path, "/c");
    EXPECT_EQ(without.place.line, 4);
    EXPECT_TRUE(contains(without.message, "states no counterpart")) << without.message;
    EXPECT_TRUE(contains(without.remedy, "add an input rule that observes it")) << without.remedy;
    EXPECT_EQ(empty.rule, "observed-counterpart");
    EXPECT_TRUE(contains(empty.message, "no simplex in place 1")) << empty.message;
}

TEST(Validation, PairsTheNthDemandWithTheNthObservation) {
    const std::string axes = simplex("/o1", "Axis") + simplex("/o2", "Axis") +
                             simplex("/d1", "Axis") + simplex("/d2", "Axis") +
                             simplex("/d3", "Axis");
    const std::string three =
        relate("demands", "/d1") + relate("demands", "/d2") + relate("demands", "/d3");

    const auto two = checkSmall(
        axes + simplex("/c", "Controller", relate("axes", "/o1") + relate("axes", "/o2") + three));
    const auto one = checkSmall(axes + simplex("/c", "Controller", relate("axes", "/o1") + three));

    ASSERT_EQ(two.count("observed-counterpart"), 1U) << two.report.text();
    EXPECT_TRUE(contains(two.find("observed-counterpart")->message, "no simplex in place 3"));
    EXPECT_TRUE(one.report.ok()) << one.report.text();  // one observation serves all
}

TEST(Validation, AllowsSeveralWritersOnlyWhereTheTypeDoes) {
    const std::string writers =
        simplex("/c1", "Controller", relate("axes", "/o") + relate("demands", "/d")) +
        simplex("/c2", "Controller", relate("axes", "/o") + relate("demands", "/d")) +
        simplex("/o", "Axis");

    const auto one = only(checkSmall(writers + simplex("/d", "Axis")));
    const auto many = checkSmall(writers + simplex("/d", "SharedAxis"));

    EXPECT_EQ(one.rule, "several-writers");
    EXPECT_EQ(one.path, "/d");
    EXPECT_EQ(one.place.line, 9);
    EXPECT_TRUE(contains(one.message, "/c2 writes it")) << one.message;
    EXPECT_TRUE(contains(one.remedy, "writers=\"many\" for type Axis (small.xml:")) << one.remedy;
    EXPECT_TRUE(many.report.ok()) << many.report.text();
}

TEST(Validation, FindsWritersOfWhomSomeAreDelayed) {
    const auto byRelate = only(
        checkSmall(simplex("/c1", "Controller",
                           relate("axes", "/o") + relate("demands", "/d", "delayed=\"true\"")) +
                   simplex("/c2", "Controller", relate("axes", "/o") + relate("demands", "/d")) +
                   simplex("/o", "Axis") + simplex("/d", "SharedAxis")));
    const auto byRule =
        checkSmall(simplex("/c", "Controller", relate("axes", "/o") + relate("demands", "/d")) +
                   simplex("/dev", "Device", relate("observation", "/d")) + simplex("/o", "Axis") +
                   simplex("/d", "SharedAxis"));

    EXPECT_EQ(byRelate.rule, "delayed-mixed");
    EXPECT_EQ(byRelate.place.line, 5);
    EXPECT_EQ(byRelate.remedy, "write <relate rule=\"demands\" to=\"/d\"/>");
    ASSERT_NE(byRule.find("delayed-mixed"), nullptr) << byRule.report.text();
    EXPECT_EQ(byRule.find("delayed-mixed")->remedy,
              "write <relate rule=\"demands\" to=\"/d\" delayed=\"true\"/>");
}

TEST(Validation, FindsSafeValuesThatADelayedOutputOfAControllerWouldIgnore) {
    const auto finding = only(
        checkSmall(simplex("/c", "Controller",
                           relate("axes", "/o") + relate("demands", "/d", "delayed=\"true\"")) +
                   simplex("/o", "Axis") + simplex("/d", "Axis")));

    EXPECT_EQ(finding.severity, Severity::Error);
    EXPECT_EQ(finding.rule, "delayed-safe");
    EXPECT_EQ(finding.path, "/c");
    EXPECT_EQ(finding.place.line, 5);
    EXPECT_TRUE(contains(finding.message,
                         "is delayed, so /d is an observation, and safe of 'mode' (small.xml:15), "
                         "'note' (small.xml:16), 'position' (small.xml:13), 'velocity' "
                         "(small.xml:14) is ignored: in Standby and Fault"))
        << finding.message;
    EXPECT_TRUE(finding.remedy.starts_with("write <relate rule=\"demands\" to=\"/d\"/>; "))
        << finding.remedy;
    const CheckedModel shown =
        checkSmall(simplex("/c", "Controller",
                           relate("axes", "/o") + relate("demands", "/d", "delayed=\"true\"")) +
                   simplex("/shown", "Shown", relate("axes", "/d")) + simplex("/o", "Axis") +
                   simplex("/d", "Axis"));
    EXPECT_EQ(shown.count("delayed-safe"), 1U) << "who only describes writes nothing";
}

TEST(Validation, FindsThemWhereADeviceFollowsWhatIsDelayed) {
    const std::string follows =
        simplex("/drive", "Drive", relate("demands", "/a")) + simplex("/a", "Axis");
    const auto delayed = only(checkSmall(simplex("/p", "Pair", relate("left", "/a")) + follows));
    const auto nobody =
        checkSmall(simplex("/p", "Pair", relate("left", "/a")) +
                   simplex("/w", "Watcher", relate("seen", "/a")) + simplex("/a", "Axis"));
    const auto measured =
        checkSmall(simplex("/s", "Device", relate("observation", "/a")) + follows);
    const auto without =
        checkSmall(simplex("/p", "Painter", relate("lights", "/l")) + simplex("/l", "Lamp"));

    EXPECT_EQ(delayed.rule, "delayed-safe");
    EXPECT_TRUE(delayed.remedy.starts_with(
        "remove delayed=\"true\" from rule 'left' (small-morphology.xml:"))
        << delayed.remedy;
    for (const CheckedModel* model : {&nobody, &measured, &without}) {
        EXPECT_EQ(model->count("delayed-safe"), 0U) << model->report.text();
    }
}

TEST(Validation, FindsASimplexThatOneOwnerWritesByTwoRules) {
    const auto finding =
        only(checkSmall(simplex("/p", "Pair", relate("right", "/a") + relate("left", "/a")) +
                        simplex("/a", "SharedAxis")));

    EXPECT_EQ(finding.rule, "output-twice");
    EXPECT_EQ(finding.path, "/p");
    EXPECT_EQ(finding.place.line, 5);
    EXPECT_TRUE(contains(finding.message, "rule 'left'")) << finding.message;
    EXPECT_TRUE(contains(finding.message, "writes /a, and so does rule 'right'"));
    EXPECT_EQ(finding.remedy, "remove this <relate>, or relate another simplex");
}

TEST(Validation, KeepsTheRefiningOneOfTwoRulesThatWriteASimplex) {
    const auto inner = relate("third", "/a"), general = relate("demands", "/a");
    int line = 5;
    for (const std::string& both : {inner + general, general + inner}) {
        const auto checked =
            checkSmall(simplex("/c", "BlindController", both) + simplex("/a", "Axis"));
        ASSERT_EQ(checked.count("output-twice"), 1U) << checked.report.text();
        const Finding& finding = *checked.find("output-twice");
        EXPECT_EQ(finding.place.line, line--);
        EXPECT_TRUE(contains(finding.remedy, "one under 'third' counts for 'demands' too"));
    }
    const auto once = checkSmall(simplex("/c", "BlindController", inner) + simplex("/a", "Axis"));
    EXPECT_EQ(once.count("output-twice"), 0U) << once.report.text();
}

TEST(Validation, TakesOneSimplexUnderTwoRulesWhereNothingIsWritten) {
    const auto commanded =
        checkSmall(simplex("/p", "Pair", relate("ask", "/s") + relate("tell", "/s")) +
                   simplex("/s", "Switch"));
    const auto readAndWritten = checkSmall(
        simplex("/d", "Device",
                relate("demand", "/a", "delayed=\"true\"") + relate("observation", "/a")) +
        simplex("/a", "Axis"));

    EXPECT_EQ(commanded.report.text(), "");
    EXPECT_EQ(readAndWritten.report.text(), "");
}

std::string watched(const std::string& cluster, const std::string& rate) {
    return cluster + "\n" + simplex("/d", "Device", relate("observation", "/a"), rate) +
           simplex("/w", "Watcher", relate("seen", "/b") + relate("seen", "/a")) +
           simplex("/a", "Axis") + simplex("/b", "Axis");
}

TEST(Validation, WarnsOfAMaxAgeBelowThreePeriodsOfWhatIsRead) {
    const auto finding =
        only(checkSmall(watched("<cluster name=\"robot\" frequency=\"1000\"/>", "every=\"2\"")));

    EXPECT_EQ(finding.severity, Severity::Warning);
    EXPECT_EQ(finding.rule, "max-age");
    EXPECT_EQ(finding.path, "/w");
    EXPECT_EQ(finding.place.line, 9);
    EXPECT_TRUE(contains(finding.message,
                         "has maxAge=\"0.004\", which is raised to 0.006: three periods of /a, "
                         "written every 2 cycles at 1000 Hz"))
        << finding.message;
    EXPECT_EQ(finding.remedy, "write maxAge=\"0.006\" or more, or leave it out");
}

TEST(Validation, WarnsOfNoMaxAgeThatHoldsOrIsNotStated) {
    const auto holds =
        checkSmall(watched("<cluster name=\"robot\" frequency=\"750\"/>", "every=\"1\""));
    const auto ofNoFrequency = checkSmall(watched("<cluster name=\"robot\"/>", "every=\"9\""));
    const auto notStated =
        checkSmall("<cluster name=\"robot\" frequency=\"1\"/>\n" +
                   simplex("/d", "Device", relate("observation", "/a")) +
                   simplex("/c", "Controller", relate("axes", "/a")) + simplex("/a", "Axis"));

    for (const CheckedModel* model : {&holds, &ofNoFrequency, &notStated}) {
        EXPECT_EQ(model->report.text(), "");
    }
}

std::string aged(const std::string& maxAge) {
    return "<cluster name=\"robot\" frequency=\"1000\"/>\n" +
           simplex("/d", "Device", relate("observation", "/a")) +
           simplex("/w", "Watcher", relate("seen", "/a", maxAge)) + simplex("/a", "Axis");
}

TEST(Validation, TakesTheAgeThatARelationshipAllowsAboveThatOfItsRule) {
    const auto checked = checkSmall(aged("maxAge=\"2.5\""));
    EXPECT_EQ(checked.report.text(), "");
    const auto structure = makeStructure("", *checked.tree);
    const auto edge = std::ranges::find(structure->edges, structure->find("/w"), &Edge::owner);
    EXPECT_EQ(edge->maxAge, 2.5);
    EXPECT_EQ(edge->rule->maxAge, 0.004);
}

TEST(Validation, RefusesAnAgeBelowThatOfTheRuleAndOneOfAnOutput) {
    const auto below = only(checkSmall(aged("maxAge=\"0.001\"")));
    EXPECT_EQ(below.severity, Severity::Error);
    EXPECT_EQ(below.rule, "max-age");
    EXPECT_EQ(below.place.line, 8);
    EXPECT_TRUE(
        contains(below.message, "maxAge=\"0.001\" is below that of the rule, which is 0.004"))
        << below.message;
    const auto output =
        only(checkSmall(simplex("/d", "Device", relate("observation", "/a", "maxAge=\"1\"")) +
                        simplex("/a", "Axis")));
    EXPECT_EQ(output.rule, "on-loss-direction");
    EXPECT_TRUE(contains(output.remedy, "leave maxAge out")) << output.remedy;
    for (const char* wrong : {"0", "-1", "nan", "inf", "1 s", ""}) {
        const auto refused = checkSmall(aged("maxAge=\"" + std::string{wrong} + '"'));
        EXPECT_EQ(refused.count("attribute-value"), 1U) << wrong << refused.report.text();
    }
}

TEST(Validation, AsksWhetherAnAgeAboveTenSecondsMeansMilliseconds) {
    const auto finding = only(checkSmall(aged("maxAge=\"200\"")));
    EXPECT_EQ(finding.severity, Severity::Warning);
    EXPECT_EQ(finding.rule, "max-age");
    EXPECT_TRUE(contains(finding.remedy, "if milliseconds were meant, write maxAge=\"0.2\""))
        << finding.remedy;
    EXPECT_EQ(checkSmall(aged("maxAge=\"10\"")).report.text(), "");
}

TEST(Validation, WarnsWhereALossIsToMakeSafeWhatIsNoDemand) {
    const std::string guarded = R"(<relate rule="guarded" to="/a" remote="true"/>)";
    const auto finding = only(checkSmall(simplex("/g", "Guard", guarded)));

    EXPECT_EQ(finding.severity, Severity::Warning);
    EXPECT_EQ(finding.rule, "safe-nothing");
    EXPECT_EQ(finding.path, "/g");
    EXPECT_TRUE(
        contains(finding.message, "onLoss=\"safe\", but nothing that it writes is a demand"))
        << finding.message;
    EXPECT_TRUE(contains(finding.remedy, "write onLoss=\"propagate\" for rule 'guarded'"));

    const auto writes =
        checkSmall(simplex("/g", "Guard", guarded + relate("made", "/d")) + simplex("/d", "Lift"));
    EXPECT_EQ(writes.report.text(), "");
}

// The safety system of a plant that no simplex tells: its stop would never be seen.
TEST(Validation, WantsAWriterOfWhatReactsToItsLoss) {
    const ModelFolder folder;
    folder.copyOntology();
    const auto checkWith = [&](const std::string& relates, const std::string& simplexes) {
        return check(folder.write("system.xml",
                                  R"(<system name="t"><morphology file="cortex-morphology.xml"/>
<simplex path="/out" type="RotaryAxisConcept"/>
<simplex path="/drive" type="SimulatedAxis"><relate rule="demand" to="/out"/>
<relate rule="observation" to="/axis"/></simplex><simplex path="/axis" type="RotaryAxisConcept"/>
<simplex path="/jog" type="JogController"><relate rule="demands" to="/out"/>)" +
                                      relates + "</simplex>" + simplexes + "</system>"));
    };
    const std::string axis = R"(<relate rule="axes" to="/axis"/>)";
    EXPECT_EQ(checkWith(axis, "").report.text(), "") << "its drive writes it";

    const std::string other = R"(<relate rule="axes" to="/other"/>)",
                      stands = R"(<simplex path="/other" type="RotaryAxisConcept"/>)";
    const Finding finding = only(checkWith(other, stands));
    EXPECT_EQ(finding.severity, Severity::Error);
    EXPECT_EQ(finding.rule, "nobody-writes");
    EXPECT_EQ(finding.path, "/jog");
    EXPECT_EQ(finding.place.text(), "system.xml:5");
    EXPECT_TRUE(contains(finding.message, "has onLoss=\"safe\", but nobody writes /other"))
        << finding.message;
    const std::string elsewhere =
        R"(<relate rule="axes" to="/other" remote="true" type="RotaryAxisConcept"/>)";
    EXPECT_TRUE(contains(finding.remedy, "remove /other here and write " + elsewhere))
        << finding.remedy;
    EXPECT_EQ(checkWith(elsewhere, "").report.text(), "");

    // What another agent has is known by the target of the rule, unless the system says more.
    const std::string remote = R"(<relate rule="axes" to="/other" remote="true")";
    const auto unnamed = checkWith(remote + "/>", "");
    EXPECT_EQ(unnamed.count("nobody-writes"), 0U);
    ASSERT_NE(unnamed.find("observed-counterpart"), nullptr) << unnamed.report.text();
    const std::string named = remote + R"( type="RotaryAxisConcept"/>)";
    EXPECT_TRUE(contains(unnamed.find("observed-counterpart")->remedy, named))
        << unnamed.report.text();
    EXPECT_EQ(checkWith(named, "").report.text(), "");
    EXPECT_EQ(validate(*checkWith(other, stands).tree, Extent::Part).text(), "")
        << "in a test, whose program writes it";
}

TEST(Validation, AsksWhetherTheRangeOfARotaryAxisIsInDegrees) {
    const ModelFolder folder;
    folder.copyOntology();
    const auto checkRange = [&](const std::string& range) {
        folder.write("own.xml", R"(<ontology name="own"><include file="robotics.xml"/>
<type name="Table" extends="RotaryAxisConcept" version="1.0"><data name="position" )" +
                                    range + "/></type></ontology>");
        return check(folder.write("system.xml",
                                  R"(<system name="t"><ontology file="own.xml"/>
<morphology file="cortex-morphology.xml"/><simplex path="/a" type="Table"/>
<simplex path="/b" type="Table"/></system>)"));
    };
    EXPECT_EQ(checkRange(R"(min="-3.2" max="99")").report.text(), "");
    const Finding finding = only(checkRange(R"(min="-180" max="90")"));
    EXPECT_EQ(finding.severity, Severity::Warning);
    EXPECT_EQ(finding.rule, "angle-range");
    EXPECT_EQ(finding.place.text(), "own.xml:2");
    EXPECT_TRUE(contains(finding.message, "reaches to 180 rad, which is 29 turns"))
        << finding.message;
    EXPECT_EQ(finding.remedy, "write 3.1416 for 180 degrees");
}

TEST(Validation, WantsOneUnitForItemsOfOneNameInAPair) {
    const std::string parts = simplex("/lift", "Lift") + simplex("/slide", "Slide") +
                              simplex("/lift2", "Lift") + simplex("/slide2", "Slide");
    const std::string seen = relate("seen", "/lift") + relate("seen", "/slide");

    const auto crossed = checkSmall(
        simplex("/m", "Mover", seen + relate("moved", "/slide2") + relate("moved", "/lift2")) +
        parts);

    EXPECT_EQ(crossed.count("pair-unit"), 2U) << crossed.report.text();
    const Finding* first = crossed.find("pair-unit");
    EXPECT_EQ(first->path, "/m");
    EXPECT_EQ(first->message,
              "/slide2 (rule 'moved') has 'position' in mm, its pair /lift (rule 'seen') has "
              "'position' in m; their units of 'turn' differ, too");
    EXPECT_EQ(first->place.line, 6);
}

TEST(Validation, WarnsWhereAValueIsReadAndWrittenInTwoUnitsOfOneDimension) {
    const std::string parts = simplex("/lift", "Lift") + simplex("/slide", "Slide");
    const std::string lifts = simplex("/lift", "Lift") + simplex("/lift2", "Lift");

    const auto mixed = checkSmall(
        simplex("/s", "Mover",
                relate("other", "/lift") + relate("seen", "/slide") + relate("moved", "/slide2")) +
        simplex("/slide2", "Slide") + parts);
    const auto same = checkSmall(
        simplex("/s", "Mover", relate("seen", "/lift") + relate("moved", "/lift2")) + lifts);

    EXPECT_TRUE(mixed.report.ok()) << mixed.report.text();
    ASSERT_EQ(mixed.count("flow-unit"), 1U) << mixed.report.text();  // rad and 1 may differ
    EXPECT_TRUE(contains(mixed.find("flow-unit")->message, "reads and writes 'position'"));
    EXPECT_EQ(same.count("flow-unit"), 0U) << same.report.text();
}

}  // namespace
}  // namespace cortex
