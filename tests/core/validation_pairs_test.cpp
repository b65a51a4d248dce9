// SPDX-License-Identifier: Apache-2.0
#include "core/model_folder.hpp"

#include <algorithm>

#include <gtest/gtest.h>

// Who belongs to whom, as the shipped types say it: examples/ds402_dual_axis with lines exchanged.
namespace cortex::test {
namespace {

const std::string systemName = "ds402_dual_axis.xml";
const std::string aToSet = R"(<relate rule="setpoints" to="/set/a"/>)";
const std::string bToSet = R"(<relate rule="setpoints" to="/set/b"/>)";

void exchange(std::string& text, const std::string& first, const std::string& second) {
    const std::size_t from = text.find(first), to = text.find(second);
    ASSERT_TRUE(from < to && to != std::string::npos) << first << " and " << second;
    text.replace(to, second.size(), first);
    text.replace(from, first.size(), second);
}

void put(std::string& text, const std::string& before, const std::string& after) {
    const std::size_t at = text.find(before);
    ASSERT_NE(at, std::string::npos) << before;
    text.replace(at, before.size(), after);
}

class DualAxis {
public:
    DualAxis() {
        const std::string from = CORTEX_SOURCE_DIR "/examples/ds402_dual_axis/";
        folder_.copyOntology();
        folder_.write("table-types.xml", textOf(from + "table-types.xml"));
        text = textOf(from + systemName);
    }
    CheckedModel check() const { return test::check(folder_.write(systemName, text)); }
    std::string place(const std::string& line) const {
        const auto before = text.begin() + static_cast<std::ptrdiff_t>(text.find(line));
        return systemName + ":" + std::to_string(std::count(text.begin(), before, '\n') + 1);
    }
    void append(const std::string& simplexes) { put(text, "</system>", simplexes + "</system>"); }
    void exchangeUnder(const std::string& rule, const std::string& first,
                       const std::string& second) {
        const std::string begin = "<relate rule=\"" + rule + "\" to=\"";
        exchange(text, begin + first + "\"/>", begin + second + "\"/>");
    }

    std::string text;

private:
    ModelFolder folder_;
};

TEST(CrossedPairs, AreRefusedWhereAProcessorTellsEachDriveWhatTheOtherIsToDo) {
    DualAxis plant;
    ASSERT_EQ(plant.check().report.text(), "");

    exchange(plant.text, aToSet, bToSet);
    const Finding finding = only(plant.check());

    EXPECT_EQ(finding.rule, "pair-crossed") << finding.message;
    EXPECT_EQ(finding.severity, Severity::Error);
    EXPECT_EQ(finding.path, "/processor");
    EXPECT_EQ(finding.place.text(), plant.place(bToSet));
    const auto placeOf = [&](const std::string& rule, const std::string& to) {
        return to + " (rule '" + rule + "', " +
               plant.place("<relate rule=\"" + rule + "\" to=\"" + to + "\"/>") + ")";
    };
    EXPECT_EQ(finding.message, "/set/b (rule 'setpoints') stands in the place of " +
                                   placeOf("drives", "/drive/a") + ", but in /drive " +
                                   placeOf("demands", "/set/b") + " stands in the place of " +
                                   placeOf("observations", "/drive/b"));
    EXPECT_TRUE(finding.remedy.starts_with("exchange this line and " + aToSet + " (" +
                                           plant.place(aToSet) +
                                           "); if the order in /drive is wrong"))
        << finding.remedy;
}

TEST(CrossedPairs, AreRefusedWhereADriveTellsThemInAnotherOrder) {
    DualAxis plant;
    plant.exchangeUnder("observations", "/drive/a", "/drive/b");

    const Finding finding = only(plant.check());

    EXPECT_EQ(finding.rule, "pair-crossed") << finding.message;
    EXPECT_EQ(finding.path, "/processor");
    EXPECT_TRUE(contains(finding.remedy,
                         "if the order in /drive is wrong, exchange <relate rule=\"demands\" "
                         "to=\"/set/a\"/> ("))
        << finding.remedy;
}

TEST(CrossedPairs, AreNoneWhereAllGoInAnotherOrder) {
    DualAxis plant;
    plant.exchangeUnder("setpoints", "/set/a", "/set/b");
    plant.exchangeUnder("drives", "/drive/a", "/drive/b");
    plant.exchangeUnder("demands", "/demand/a", "/demand/b");

    EXPECT_EQ(plant.check().report.text(), "");
}

TEST(CrossedPairs, AreToldOfTheOneThatSaysItInAnotherWayThanAllOthers) {
    DualAxis plant;
    plant.exchangeUnder("demands", "/demand/a", "/demand/b");

    const Finding finding = only(plant.check());
    EXPECT_EQ(finding.rule, "pair-crossed");
    EXPECT_EQ(finding.path, "/processor");
    EXPECT_TRUE(finding.remedy.starts_with("exchange this line and <relate rule=\"demands\" to="))
        << finding.remedy;
}

// The arm's drive and two more say what observes its demand.
TEST(CrossedPairs, AreToldOfADeviceThatFollowsTheDemandOfAnotherAxis) {
    const ModelFolder folder;
    folder.copyOntology();
    const std::string from = CORTEX_SOURCE_DIR "/examples/swap_gripper/";
    folder.write("cell-types.xml", textOf(from + "cell-types.xml"));
    std::string text = textOf(from + "jaws.xml");
    const std::string right = R"(<relate rule="demand" to="/gripper/demand"/>)";
    put(text, right, R"(<relate rule="demand" to="/arm/demands/x"/>)");

    const Finding finding = only(check(folder.write("jaws.xml", text)));
    EXPECT_EQ(finding.rule, "pair-crossed");
    EXPECT_EQ(finding.path, "/gripper/device");
    EXPECT_TRUE(finding.remedy.starts_with("write " + right + ", or ")) << finding.remedy;
}

TEST(CrossedPairs, AreRefusedForAControllerThatReadsOneAxisAndMovesAnother) {
    DualAxis plant;
    put(plant.text,
        "/a/pose\" type=\"AxisPoseController\">\n    <relate rule=\"axes\" to=\"/drive/a",
        "/a/pose\" type=\"AxisPoseController\">\n    <relate rule=\"axes\" to=\"/drive/b");

    const Finding finding = only(plant.check());

    EXPECT_EQ(finding.rule, "pair-crossed") << finding.message;
    EXPECT_EQ(finding.path, "/a/pose");
    EXPECT_TRUE(finding.remedy.starts_with(
        "write <relate rule=\"axes\" to=\"/drive/a\"/> in the place of "))
        << finding.remedy;
}

const std::string twoDevices = R"(
  <simplex path="/seen/1" type="RotaryAxisObservation"/>
  <simplex path="/seen/2" type="RotaryAxisObservation"/>
  <simplex path="/wish/1" type="TableAxis"/>
  <simplex path="/wish/2" type="TableAxis"/>
  <simplex path="/sim/1" type="SimulatedAxis">
    <relate rule="demand" to="/wish/1"/><relate rule="observation" to="/seen/1"/>
  </simplex>
  <simplex path="/sim/2" type="SimulatedAxis">
    <relate rule="demand" to="/wish/2"/><relate rule="observation" to="/seen/2"/>
  </simplex>
)";

std::string controller(const std::string& axes, const std::string& demands,
                       const std::string& more = "") {
    std::string text = "<simplex path=\"/control\" type=\"AxisPoseController\">";
    for (const char axis : axes)
        text += "<relate rule=\"axes\" to=\"/seen/" + std::string{axis} + "\"" + more + "/>";
    for (const char axis : demands)
        text += "<relate rule=\"demands\" to=\"/wish/" + std::string{axis} + "\"/>";
    return text + "</simplex>";
}

TEST(CrossedPairs, AreRefusedOfDevicesWithOneAxisEach) {
    DualAxis straight, crossed;
    straight.append(twoDevices + controller("12", "12"));
    crossed.append(twoDevices + controller("12", "21"));

    EXPECT_EQ(straight.check().report.text(), "");
    const CheckedModel found = crossed.check();
    ASSERT_EQ(found.count("pair-crossed"), 2U) << found.report.text();
    EXPECT_EQ(found.find("pair-crossed")->path, "/control");
    EXPECT_TRUE(found.find("pair-crossed")
                    ->remedy.starts_with("exchange this line and <relate rule=\"demands\" "
                                         "to=\"/wish/1\"/>"))
        << found.report.text();
}

// Each device and each controller has one axis, so no two of them have both in their lines.
TEST(CrossedPairs, AreRefusedOverTheWholeSystemWhereEachHasOneAxis) {
    const std::string devices = twoDevices;
    const auto single = [](char axis, char demand) {
        return R"(<simplex path="/control/)" + std::string{axis} +
               R"(" type="JogController"><relate rule="axes" to="/seen/)" + axis +
               R"("/><relate rule="demands" to="/wish/)" + demand + R"("/></simplex>)";
    };
    DualAxis straight, crossed, half;
    straight.append(devices + single('1', '1') + single('2', '2'));
    crossed.append(devices + single('1', '2') + single('2', '1'));
    half.append(devices + single('1', '2'));

    EXPECT_EQ(straight.check().report.text(), "");
    const CheckedModel found = crossed.check();
    ASSERT_EQ(found.count("pair-crossed"), 2U) << found.report.text();
    const Finding* first = found.find("pair-crossed");
    EXPECT_EQ(first->path, "/control/1");
    EXPECT_TRUE(contains(first->message, "but in /sim/2 /wish/2 (rule 'demand'")) << first->message;
    EXPECT_TRUE(first->remedy.starts_with(
        "write <relate rule=\"axes\" to=\"/seen/2\"/> in the place of <relate rule=\"axes\" "
        "to=\"/seen/1\"/>"))
        << first->remedy;
    EXPECT_EQ(half.check().count("pair-crossed"), 1U) << "the other axis has no controller";
}

// Two motors of one joint, whose own encoder nobody moves.
TEST(CrossedPairs, AreNoneWhereTwoControllersObserveOneJoint) {
    DualAxis plant;
    std::string both;
    for (const char motor : {'1', '2'}) {
        both += R"(<simplex path="/control/)" + std::string{motor} +
                R"(" type="JogController"><relate rule="axes" to="/joint" remote="true"/>)" +
                R"(<relate rule="demands" to="/wish/)" + motor + R"("/></simplex>)";
    }
    plant.append(twoDevices + both);

    EXPECT_EQ(plant.check().count("pair-crossed"), 0U) << plant.check().report.text();
}

// A sensor that the device does not have: nobody else says whose place it takes.
TEST(CrossedPairs, AreNoneWhereWhatIsObservedComesFromElsewhere) {
    DualAxis plant;
    plant.append(twoDevices +
                 controller("43", "12", " remote=\"true\" type=\"RotaryAxisObservation\""));

    EXPECT_EQ(plant.check().report.text(), "");
}

// The same two devices, and a type of the test's own.
CheckedModel checkWith(const std::string& type, const std::string& rules,
                       const std::string& simplexes) {
    const ModelFolder folder;
    folder.copyOntology();
    folder.write("own.xml",
                 "<ontology name=\"own\" version=\"1.0\"><include file=\"robotics.xml\"/>" + type +
                     "</ontology>\n");
    folder.write("own-morphology.xml",
                 "<morphology name=\"own\"><include file=\"own.xml\"/><include "
                 "file=\"robotics-morphology.xml\"/>" +
                     rules + "</morphology>\n");
    std::string devices = twoDevices;
    for (int i = 0; i < 2; ++i) put(devices, "TableAxis", "RotaryAxisConcept");
    return check(
        folder.write("system.xml", "<system name=\"t\"><morphology file=\"own-morphology.xml\"/>" +
                                       devices + simplexes + "</system>"));
}

// One axis with two motors: it observes for both.
TEST(CrossedPairs, AreNoneWhereOneObservesForAll) {
    const CheckedModel checked =
        checkWith(R"(<type name="Tandem" extends="Processor" version="1.0"/>)",
                  R"(<rules type="Tandem">
  <relationship name="axis" direction="input" target="AxisConcept" min="1" max="1" refines="inputs"/>
  <relationship name="motors" direction="output" target="AxisConcept" min="2" max="2"
                refines="outputs" counterpart="axis"/></rules>)",
                  R"(<simplex path="/tandem" type="Tandem"><relate rule="axis" to="/seen/2"/>
  <relate rule="motors" to="/wish/1"/><relate rule="motors" to="/wish/2"/></simplex>)");

    EXPECT_EQ(checked.report.text(), "");
}

// Two inputs side by side that observe nothing of their owner's: it compares whom it likes.
TEST(CrossedPairs, AreNoneForWhoComparesADemandWithAnotherAxis) {
    const CheckedModel checked =
        checkWith(R"(<type name="Compare" extends="Monitor" version="1.0"/>)",
                  R"(<rules type="Compare">
  <relationship name="left" direction="input" target="AxisConcept" min="1" refines="inputs"/>
  <relationship name="right" direction="input" target="AxisConcept" min="1" refines="inputs"
                sameCount="left"/></rules>)",
                  controller("12", "12") +
                      R"(<simplex path="/compare" type="Compare">
  <relate rule="left" to="/seen/1"/><relate rule="left" to="/seen/2"/>
  <relate rule="right" to="/wish/2"/><relate rule="right" to="/wish/1"/></simplex>)");

    EXPECT_EQ(checked.report.text(), "");
}

// Axes of another agent are known by their paths.
TEST(CrossedPairs, AreRefusedOfAxesThatAnotherAgentHas) {
    const std::string remote = " remote=\"true\" type=\"RotaryAxisObservation\"";
    const std::string follower =
        "<simplex path=\"/wish/1\" type=\"TableAxis\"/><simplex path=\"/wish/2\" "
        "type=\"TableAxis\"/><simplex path=\"/out/1\" type=\"TableAxis\"/>"
        "<simplex path=\"/out/2\" type=\"TableAxis\"/>"
        "<simplex path=\"/follow\" type=\"FollowAxisController\">"
        "<relate rule=\"axes\" to=\"/seen/1\"" +
        remote + "/>" + "<relate rule=\"axes\" to=\"/seen/2\"" + remote + "/>" +
        "<relate rule=\"targets\" to=\"/wish/1\"/><relate rule=\"targets\" to=\"/wish/2\"/>"
        "<relate rule=\"demands\" to=\"/out/1\"/><relate rule=\"demands\" to=\"/out/2\"/>"
        "</simplex>";
    DualAxis straight, crossed;
    straight.append(follower + controller("12", "12", remote));
    crossed.append(follower + controller("12", "21", remote));

    EXPECT_EQ(straight.check().report.text(), "");
    EXPECT_EQ(only(crossed.check()).rule, "pair-crossed") << crossed.check().report.text();
}

}  // namespace
}  // namespace cortex::test
