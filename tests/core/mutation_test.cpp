// SPDX-License-Identifier: Apache-2.0
#include "core/mutation.hpp"

#include <algorithm>
#include <vector>

#include <stdlib.h>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

constexpr char morphology[] = "robotics-morphology.xml";
constexpr char ontology[] = "robotics.xml";

const std::vector<Mutation> mutations{
    // Relationships
    {.name = "ArmWithoutGripper",
     .file = systemFile,
     .before = "    <relate rule=\"gripper\" to=\"/arm/gripper\"/>\n",
     .after = "",
     .rule = "below-min",
     .path = "/arm",
     .at = "path=\"/arm\"",
     .remedy = Remedy::Insert},
    {.name = "ArmWithoutAnyGripper",
     .file = systemFile,
     .before = "    <relate rule=\"gripper\" to=\"/arm/gripper\"/>\n  </simplex>\n"
               "  <simplex path=\"/arm/lbr\" type=\"KukaLbr\"/>\n"
               "  <simplex path=\"/arm/gripper\" type=\"Robotiq2Finger\"/>\n",
     .after = "  </simplex>\n  <simplex path=\"/arm/lbr\" type=\"KukaLbr\"/>\n",
     .rule = "below-min",
     .path = "/arm",
     .at = "path=\"/arm\"",
     .remedy = Remedy::Add},
    {.name = "UnknownRule",
     .file = systemFile,
     .before = "rule=\"gripper\"",
     .after = "rule=\"griper\"",
     .rule = "unknown-rule",
     .path = "/arm",
     .at = "griper",
     .remedy = Remedy::Replace},
    {.name = "UnknownTarget",
     .file = systemFile,
     .before = "rule=\"manipulator\" to=\"/arm/lbr\"",
     .after = "rule=\"manipulator\" to=\"/arm/lbt\"",
     .rule = "unknown-path",
     .path = "/arm",
     .at = "/arm/lbt",
     .remedy = Remedy::Replace},
    {.name = "TargetOfTheWrongType",
     .file = systemFile,
     .before = "rule=\"manipulator\" to=\"/arm/lbr\"",
     .after = "rule=\"manipulator\" to=\"/arm/gripper\"",
     .rule = "target-type",
     .path = "/arm",
     .at = "rule=\"manipulator\"",
     .remedy = Remedy::Replace},
    {.name = "TargetTwice",
     .file = systemFile,
     .before = "    <relate rule=\"gripper\" to=\"/arm/gripper\"/>\n  </simplex>",
     .after = "  </simplex>\n  <simplex path=\"/spare\" type=\"HtcViveHandset\">\n"
              "    <relate rule=\"buttons\" to=\"/handset/grip\"/>\n"
              "    <relate rule=\"buttons\" to=\"/handset/grip\"/><!-- again -->\n  </simplex>",
     .rule = "target-twice",
     .path = "/spare",
     .at = "again"},
    {.name = "ButtonTwice",
     .file = systemFile,
     .before = "type=\"HtcViveHandset\">\n",
     .after = "type=\"HtcViveHandset\">\n    <relate rule=\"buttons\" to=\"/handset/menu\"/>\n",
     .rule = "target-twice",
     .path = "/handset",
     .at = "to=\"/handset/menu\"/>\n  </simplex>\n  <simplex path=\"/handset/trigger\"",
     .remedy = Remedy::Remove},
    {.name = "SecondGripper",
     .file = systemFile,
     .before = "    <relate rule=\"gripper\" to=\"/arm/gripper\"/>\n  </simplex>",
     .after = "    <relate rule=\"gripper\" to=\"/arm/gripper\"/>\n"
              "    <relate rule=\"gripper\" to=\"/spare\"/>\n  </simplex>\n"
              "  <simplex path=\"/spare\" type=\"Robotiq2Finger\"/>",
     .rule = "above-max",
     .path = "/arm",
     .at = "to=\"/spare\"",
     .remedy = Remedy::Remove},
    {.name = "OutputOfAnotherAgent",
     .file = systemFile,
     .before = "<relate rule=\"pose\" to=\"/handset/pose\"/>",
     .after = "<relate rule=\"pose\" to=\"/handset/pose\"/>\n"
              "    <relate rule=\"observations\" to=\"/far/axis\" remote=\"true\"/>",
     .rule = "remote-output",
     .path = "/playback",
     .at = "/far/axis",
     .remedy = Remedy::Remove},
    {.name = "RemoteSimplexOfThisSystem",
     .file = systemFile,
     .before = "rule=\"manipulator\" to=\"/arm/lbr\"",
     .after = "rule=\"manipulator\" to=\"/arm/lbr\" remote=\"true\"",
     .rule = "remote-local",
     .path = "/arm",
     .at = "remote",
     .remedy = Remedy::Replace},

    // Simplexes
    {.name = "InstanceOfAnAbstractType",
     .file = systemFile,
     .before = "type=\"Robotiq2Finger\"",
     .after = "type=\"Gripper\"",
     .rule = "abstract-type",
     .path = "/arm/gripper",
     .at = "type=\"Gripper\"",
     .remedy = Remedy::Attribute},
    {.name = "UnknownType",
     .file = systemFile,
     .before = "type=\"KukaLbr\"",
     .after = "type=\"KukaLbt\"",
     .rule = "unknown-type",
     .path = "/arm/lbr",
     .at = "KukaLbt",
     .remedy = Remedy::Attribute},
    {.name = "PathTwice",
     .file = systemFile,
     .before = "<simplex path=\"/handset/menu\"",
     .after = "<simplex path=\"/handset/grip\"",
     .rule = "duplicate-path",
     .path = "/handset/grip",
     .at = "<simplex path=\"/handset/grip\""},
    {.name = "MalformedPath",
     .file = systemFile,
     .before = "path=\"/drives/1\"",
     .after = "path=\"/drives/o ne\"",
     .rule = "malformed-path",
     .path = "/drives/o ne",
     .at = "o ne",
     .remedy = Remedy::Attribute,
     .structural = true},
    {.name = "RunsNever",
     .file = systemFile,
     .before = "type=\"TrackingMonitor\"",
     .after = "type=\"TrackingMonitor\" every=\"0\"",
     .rule = "attribute-value",
     .path = "/tracking",
     .at = "every",
     .structural = true},
    {.name = "PhaseBeyondThePeriod",
     .file = systemFile,
     .before = "type=\"TrackingMonitor\"",
     .after = "type=\"TrackingMonitor\" every=\"2\" phase=\"2\"",
     .rule = "phase-range",
     .path = "/tracking",
     .at = "phase"},
    {.name = "PathOfTheCluster",
     .file = systemFile,
     .before = "<cluster name=\"teleop\"",
     .after = "<cluster name=\"tracking\"",
     .rule = "cluster-path",
     .path = "/tracking",
     .at = "path=\"/tracking\"",
     .remedy = Remedy::Attribute},
    {.name = "OtherTypeAtACreatedPath",
     .file = systemFile,
     .before = "<simplex path=\"/arm/gripper\"",
     .after = "<simplex path=\"/arm/lbr/axes/3\" type=\"KukaLbrAxis4\"/>\n"
              "  <simplex path=\"/arm/gripper\"",
     .rule = "created-path",
     .path = "/arm/lbr/axes/3",
     .at = "KukaLbrAxis4",
     .remedy = Remedy::Attribute},

    // Settings
    {.name = "UnknownItem",
     .file = systemFile,
     .before = "<set data=\"startPosition\" value=\"0.6\"/>",
     .after = "<set data=\"startPositon\" value=\"0.6\"/>",
     .rule = "unknown-item",
     .path = "/drives/2",
     .at = "startPositon",
     .remedy = Remedy::Replace},
    {.name = "WordForANumber",
     .file = systemFile,
     .before = "value=\"0.6\"",
     .after = "value=\"high\"",
     .rule = "setting-kind",
     .path = "/drives/2",
     .at = "high",
     .remedy = Remedy::Replace},
    {.name = "ValueOutOfRange",
     .file = systemFile,
     .before = "<set data=\"startPosition\" value=\"0.6\"/>",
     .after = "<set data=\"naturalFrequency\" value=\"20\"/>",
     .rule = "setting-range",
     .path = "/drives/2",
     .at = "naturalFrequency",
     .remedy = Remedy::Replace},
    {.name = "NumberWithoutLabel",
     .file = systemFile,
     .before = "<set data=\"loop\" value=\"true\"/>",
     .after = "<set data=\"source\" value=\"2\"/>",
     .rule = "setting-range",
     .path = "/playback",
     .at = "source",
     .remedy = Remedy::Replace},
    {.name = "NotANumber",
     .file = systemFile,
     .before = "value=\"0.6\"",
     .after = "value=\"nan\"",
     .rule = "setting-finite",
     .path = "/drives/2",
     .at = "nan",
     .remedy = Remedy::Replace},
    {.name = "TwoValuesForOne",
     .file = systemFile,
     .before = "value=\"0.6\"",
     .after = "value=\"0.6 0.7\"",
     .rule = "setting-length",
     .path = "/drives/2",
     .at = "0.6 0.7",
     .remedy = Remedy::Replace},
    {.name = "TooFewValuesOfAnArray",
     .file = systemFile,
     .before = "<simplex path=\"/arm/gripper\"",
     .after = "<simplex path=\"/arm/lbr/axes/3\" type=\"KukaLbrAxis3\">\n"
              "    <set data=\"originPosition\" value=\"0 0\"/>\n  </simplex>\n"
              "  <simplex path=\"/arm/gripper\"",
     .rule = "setting-length",
     .path = "/arm/lbr/axes/3",
     .at = "originPosition",
     .remedy = Remedy::Replace},
    {.name = "StateIsNotSet",
     .file = systemFile,
     .before = "<set data=\"startPosition\" value=\"0.6\"/>",
     .after = "<set data=\"state\" value=\"2\"/>",
     .rule = "setting-framework",
     .path = "/drives/2",
     .at = "state",
     .remedy = Remedy::Remove},
    {.name = "MeasuredItemIsNotSet",
     .file = systemFile,
     .before = "<set data=\"startPosition\" value=\"0.6\"/>",
     .after = "<set data=\"taskTime\" value=\"2\"/>",
     .rule = "setting-framework",
     .path = "/drives/2",
     .at = "taskTime",
     .remedy = Remedy::Remove},
    {.name = "SetTwice",
     .file = systemFile,
     .before = "<set data=\"startPosition\" value=\"0.6\"/>",
     .after = "<set data=\"startPosition\" value=\"0.6\"/>\n"
              "    <set data=\"startPosition\" value=\"0.7\"/>",
     .rule = "duplicate-setting",
     .path = "/drives/2",
     .at = "0.7"},

    // The flow of data
    {.name = "Loop",
     .file = systemFile,
     .before = "type=\"ForwardKinematics\">\n",
     .after = "type=\"ForwardKinematics\">\n"
              "    <relate rule=\"processors\" to=\"/control/inverse\"/>\n",
     .rule = "loop",
     .path = "/control/clutch",
     .at = "rule=\"processors\" to=\"/control/inverse\"",
     .remedy = Remedy::Replace},
    {.name = "SecondWriter",
     .file = systemFile,
     .before = "  <simplex path=\"/arm\" type=\"Arm\">\n",
     .after = "  <simplex path=\"/spare\" type=\"HandsetPlayback\">\n"
              "    <relate rule=\"pose\" to=\"/spare/pose\"/>\n"
              "    <relate rule=\"buttons\" to=\"/spare/trigger\"/>\n"
              "    <relate rule=\"buttons\" to=\"/handset/grip\"/>\n"
              "  </simplex>\n"
              "  <simplex path=\"/spare/trigger\" type=\"DigitalIoConcept\"/>\n"
              "  <simplex path=\"/spare/pose\" type=\"CartesianConcept\"/>\n"
              "  <simplex path=\"/arm\" type=\"Arm\">\n",
     .rule = "several-writers",
     .path = "/handset/grip",
     .at = "to=\"/handset/grip\"",
     .remedy = Remedy::Remove},
    {.name = "OneOfTwoWritersDelayed",
     .file = systemFile,
     .before = "to=\"/arm/lbr/demands/7\"/>\n  </simplex>\n  <simplex path=\"/control/selector\"",
     .after = "to=\"/arm/lbr/demands/7\" delayed=\"true\"/>\n  </simplex>\n"
              "  <simplex path=\"/control/selector\"",
     .rule = "delayed-mixed",
     .path = "/arm/lbr/demands/7",
     .at = "delayed",
     .remedy = Remedy::Replace},
    {.name = "DemandWithoutSafeValue",
     .file = ontology,
     .before = "default=\"0 0 0\" safe=\"0 0 0\" format=\"%.4f\" description=\"Velocity of",
     .after = "default=\"0 0 0\" format=\"%.4f\" description=\"Velocity of",
     .rule = "safe-needed",
     .path = "/control/clutch/target",
     .at = "path=\"/control/clutch\"",
     .atFile = systemFile,
     .remedy = Remedy::AttributeAt},
    {.name = "ObservedWithoutCounterpart",
     .file = morphology,
     .before = "refines=\"outputs\" counterpart=\"tip\"",
     .after = "refines=\"outputs\"",
     .rule = "observed-counterpart",
     .path = "/control/clutch",
     .at = "path=\"/control/clutch\"",
     .atFile = systemFile,
     .remedy = Remedy::AttributeAt},
    {.name = "WritersOfAxesWithoutCounterpart",
     .file = morphology,
     .before = "min=\"1\" max=\"*\" refines=\"outputs\" counterpart=\"axes\"",
     .after = "min=\"1\" max=\"*\" refines=\"outputs\"",
     .rule = "observed-counterpart",
     .path = "/control/follow",
     .at = "<relate rule=\"demands\" to=\"/arm/lbr/demands/1\"/>",
     .atFile = systemFile,
     .remedy = Remedy::AttributeAt},

    // The form of the files
    {.name = "UnknownElement",
     .file = systemFile,
     .before = "<relate rule=\"gripper\"",
     .after = "<relat rule=\"gripper\"",
     .rule = "unknown-element",
     .path = "/arm",
     .at = "<relat ",
     .remedy = Remedy::Nearest,
     .structural = true},
    {.name = "UnknownAttribute",
     .file = systemFile,
     .before = "<cluster name=\"teleop\" frequency=",
     .after = "<cluster name=\"teleop\" frequnecy=",
     .rule = "unknown-attribute",
     .path = "/teleop",
     .at = "frequnecy",
     .remedy = Remedy::Nearest,
     .structural = true},
    {.name = "MissingAttribute",
     .file = systemFile,
     .before = "<simplex path=\"/arm/lbr\" type=\"KukaLbr\"/>",
     .after = "<simplex path=\"/arm/lbr\"/>",
     .rule = "missing-attribute",
     .path = "/arm/lbr",
     .at = "path=\"/arm/lbr\"",
     .structural = true},
    {.name = "FileCutOff",
     .file = systemFile,
     .before = "</system>",
     .after = "",
     .rule = "xml-syntax",
     .path = "",
     .at = "<system name",
     .structural = true},
    {.name = "Doctype",
     .file = systemFile,
     .before = "<system name=",
     .after = "<!DOCTYPE system [<!ENTITY a \"b\">]>\n<system name=",
     .rule = "xml-doctype",
     .path = "",
     .at = "<!DOCTYPE"},
    {.name = "TwoClustersOfOneName",
     .file = systemFile,
     .before = "  <cluster name=\"teleop\"",
     .after = "  <cluster name=\"teleop\"/>\n  <cluster name=\"teleop\"",
     .rule = "duplicate-cluster",
     .path = "/teleop",
     .at = "  <cluster name=\"teleop\""},
    {.name = "FileThatIsNotThere",
     .file = systemFile,
     .before = "file=\"robotics-morphology.xml\"",
     .after = "file=\"robotic-morphology.xml\"",
     .rule = "file-missing",
     .path = "",
     .at = "robotic-morphology"},
    {.name = "IncludeLoop",
     .file = ontology,
     .before = "<include file=\"base.xml\"/>",
     .after = "<include file=\"base.xml\"/>\n  <include file=\"robotics.xml\"/>",
     .rule = "include-loop",
     .path = "",
     .at = "file=\"robotics.xml\""},

    // Types
    {.name = "UnknownParent",
     .file = ontology,
     .before = "name=\"AxisConcept\" extends=\"Concept\"",
     .after = "name=\"AxisConcept\" extends=\"Concpet\"",
     .rule = "unknown-parent",
     .path = "AxisConcept",
     .at = "Concpet",
     .remedy = Remedy::Nearest},
    {.name = "TypeTwice",
     .file = ontology,
     .before = "name=\"LinearAxisObservation\"",
     .after = "name=\"RotaryAxisObservation\"",
     .rule = "duplicate-type",
     .path = "RotaryAxisObservation",
     .at = "name=\"RotaryAxisObservation\""},
    {.name = "MinimumAboveMaximum",
     .file = ontology,
     .before = "min=\"0.7\" max=\"1\"",
     .after = "min=\"1.7\" max=\"1\"",
     .rule = "range-empty",
     .path = "SimulatedAxis",
     .at = "1.7"},
    {.name = "DefaultOutOfRange",
     .file = ontology,
     .before = "max=\"15\" default=\"12\"",
     .after = "max=\"15\" default=\"20\"",
     .rule = "default-range",
     .path = "SimulatedAxis",
     .at = "default=\"20\""},
    {.name = "UnitThatIsNone",
     .file = ontology,
     .before = "unit=\"m/s\" default=\"0\" safe=\"0\"",
     .after = "unit=\"m//s\" default=\"0\" safe=\"0\"",
     .rule = "unit",
     .path = "LinearAxisConcept",
     .at = "m//s"},
    {.name = "KindThatIsNone",
     .file = ontology,
     .before = "<data name=\"engaged\" kind=\"bool\"",
     .after = "<data name=\"engaged\" kind=\"boolean\"",
     .rule = "attribute-value",
     .path = "CartesianFollowController",
     .at = "boolean",
     .structural = true},
    {.name = "ItemTwice",
     .file = ontology,
     .before = "<data name=\"engageCount\"",
     .after = "<data name=\"engaged\"",
     .rule = "duplicate-data",
     .path = "CartesianFollowController",
     .at = "<data name=\"engaged\""},
    {.name = "RangeWiderThanInherited",
     .file = ontology,
     .before = "<data name=\"model\" default=\"2F-85\"/>\n    <data name=\"payload\"",
     .after = "<data name=\"model\" default=\"2F-85\"/>\n    <data name=\"payload\" min=\"-5\"",
     .rule = "range-widened",
     .path = "Robotiq2Finger",
     .at = "min=\"-5\""},
    {.name = "KindOtherThanInherited",
     .file = ontology,
     .before = "<data name=\"model\" default=\"2F-85\"/>",
     .after = "<data name=\"model\" kind=\"int\"/>",
     .rule = "kind-changed",
     .path = "Robotiq2Finger",
     .at = "kind=\"int\""},
    {.name = "CommandOfATypeThatIsNotActive",
     .file = ontology,
     .before = "description=\"Parts that make a whole.\"/>",
     .after = "description=\"Parts that make a whole.\"><command name=\"go\"/></type>",
     .rule = "command-role",
     .path = "SubSystem",
     .at = "name=\"go\""},
    {.name = "LongCommandOfATypeThatIsNoActivity",
     .file = ontology,
     .before = "extends=\"AxisController Activity\"",
     .after = "extends=\"AxisController\"",
     .rule = "long-activity",
     .path = "AxisPoseController",
     .at = "<command name=\"moveTo\""},
    {.name = "SettableConstant",
     .file = ontology,
     .before = "settable=\"Standby\" description=\"Bandwidth",
     .after = "settable=\"Standby\" constant=\"true\" description=\"Bandwidth",
     .rule = "settable-constant",
     .path = "SimulatedAxis",
     .at = "Bandwidth"},
    {.name = "LabelTwice",
     .file = ontology,
     .before = "0:None 1:WhileMoving 2:Otherwise",
     .after = "0:None 1:WhileMoving 1:Otherwise",
     .rule = "attribute-value",
     .path = "ProcessorSelector",
     .at = "1:Otherwise"},
    {.name = "StateThatIsNone",
     .file = ontology,
     .before = "max=\"15\" default=\"12\" settable=\"Standby\"",
     .after = "max=\"15\" default=\"12\" settable=\"Stand-by\"",
     .rule = "attribute-value",
     .path = "SimulatedAxis",
     .at = "Stand-by",
     .structural = true},

    // Rules
    {.name = "UnknownTypeToCreate",
     .file = morphology,
     .before = "create=\"Robotiq2FingerAxis\"",
     .after = "create=\"Robotiq2FingrAxis\"",
     .rule = "unknown-create",
     .path = "Robotiq2Finger",
     .at = "Robotiq2FingrAxis",
     .remedy = Remedy::Nearest},
    {.name = "CreatedTypeThatIsNotTheTarget",
     .file = morphology,
     .before = "create=\"Robotiq2FingerAxis\"",
     .after = "create=\"RotaryAxisConcept\"",
     .rule = "create-target",
     .path = "Robotiq2Finger",
     .at = "create=\"RotaryAxisConcept\""},
    {.name = "CreatedTypeThatIsAbstract",
     .file = morphology,
     .before = "refines=\"outputs\" counterpart=\"axes\" create=\"RotaryAxisConcept\"",
     .after = "refines=\"outputs\" counterpart=\"axes\" create=\"AxisConcept\"",
     .rule = "create-abstract",
     .path = "InverseKinematics",
     .at = "create=\"AxisConcept\""},
    {.name = "UnknownTargetType",
     .file = morphology,
     .before = "target=\"SerialManipulator\"",
     .after = "target=\"SerialManipulater\"",
     .rule = "unknown-target",
     .path = "Arm",
     .at = "SerialManipulater",
     .remedy = Remedy::Nearest},
    {.name = "RefinesWhatIsNotInherited",
     .file = morphology,
     .before = "refines=\"outputs\" create=\"CartesianObservation\"",
     .after = "refines=\"outptus\" create=\"CartesianObservation\"",
     .rule = "refines",
     .path = "ForwardKinematics",
     .at = "outptus",
     .remedy = Remedy::Nearest},
    {.name = "DirectionOtherThanInherited",
     .file = morphology,
     .before =
         "direction=\"output\" target=\"AxisConcept\" min=\"0\" max=\"1\" counterpart=\"axes\"",
     .after = "direction=\"input\" target=\"AxisConcept\" min=\"0\" max=\"1\"",
     .rule = "direction-changed",
     .path = "OneDofManipulator",
     .at = "direction=\"input\" target=\"AxisConcept\" min=\"0\" max=\"1\""},
    {.name = "CountWiderThanInherited",
     .file = morphology,
     .before = "target=\"LinearAxisConcept\" min=\"1\" max=\"1\"",
     .after = "target=\"LinearAxisConcept\" min=\"1\" max=\"2\"",
     .rule = "count-widened",
     .path = "Robotiq2Finger",
     .at = "max=\"2\""},
    {.name = "CounterpartThatIsNoRule",
     .file = morphology,
     .before = "refines=\"outputs\" counterpart=\"tip\"",
     .after = "refines=\"outputs\" counterpart=\"tipp\"",
     .rule = "counterpart",
     .path = "CartesianFollowController",
     .at = "tipp"},
    {.name = "RuleOfAnUnknownDirection",
     .file = morphology,
     .before = "direction=\"input\" target=\"SerialManipulator\"",
     .after = "direction=\"inward\" target=\"SerialManipulator\"",
     .rule = "attribute-value",
     .path = "Arm",
     .at = "inward",
     .structural = true},
};

class ShippedFiles : public testing::TestWithParam<Mutation> {};

// The one finding that a mutation is for, or null.
const Finding* findingOf(const Mutation& mutation, const CheckedModel& model) {
    const auto found = std::ranges::find_if(model.report.findings, [&](const Finding& finding) {
        return finding.rule == mutation.rule && finding.path == mutation.path;
    });
    return found != model.report.findings.end() ? &*found : nullptr;
}

std::string schemaOf(const std::string& file) {
    if (file.find("morphology") != std::string::npos) return "morphology.xsd";
    return file == systemFile ? "system.xsd" : "ontology.xsd";
}

bool schemaTakes(const ModelFolder& folder, const std::string& file) {
    const std::string at = folder.path().string() + "/";
    const std::string command = "xmllint --nonet --noout --schema '" + at + schemaOf(file) + "' '" +
                                at + file + "' >/dev/null 2>&1";
    return std::system(command.c_str()) == 0;
}

TEST(ShippedFiles, AreValid) {
    const ModelFolder folder;
    copyShipped(folder);

    const auto model = check(folder.path() / systemFile);

    EXPECT_EQ(model.report.text(), "");
}

TEST(ShippedFiles, PassTheirSchemas) {
    const ModelFolder folder;
    copyShipped(folder);

    for (const char* file : {"base.xml", "base-morphology.xml", ontology, morphology, systemFile}) {
        EXPECT_TRUE(schemaTakes(folder, file)) << file;
    }
}

TEST_P(ShippedFiles, AreRefusedWhenMutated) {
    const Mutation& mutation = GetParam();
    const ModelFolder folder;
    copyShipped(folder);
    const std::string original = folder.read(mutation.file);
    folder.write(mutation.file, replaced(original, mutation.before, mutation.after));

    const auto model = check(folder.path() / systemFile);

    const Finding* finding = findingOf(mutation, model);
    ASSERT_NE(finding, nullptr) << model.report.text();
    const bool here = mutation.atFile == nullptr;
    const std::string file = here ? mutation.file : mutation.atFile;
    const std::size_t length = here ? std::string_view{mutation.after}.size() : 0;
    EXPECT_EQ(finding->place.file, file);
    EXPECT_EQ(finding->place.line, lineOf(folder.read(file), mutation.at,
                                          here ? original.find(mutation.before) : 0, length))
        << finding->text();
    EXPECT_EQ(finding->severity, mutation.severity);
    EXPECT_FALSE(finding->remedy.empty()) << finding->text();
    if (mutation.structural) {
        EXPECT_FALSE(schemaTakes(folder, mutation.file));
    }
    if (mutation.remedy == Remedy::None) return;

    applyRemedy(folder, *finding, mutation.remedy);

    EXPECT_EQ(check(folder.path() / systemFile).report.text(), "") << finding->text();
}

INSTANTIATE_TEST_SUITE_P(Mutations, ShippedFiles, testing::ValuesIn(mutations),
                         [](const auto& each) { return std::string{each.param.name}; });

TEST(ShippedFiles, AreMutatedInFortyKindsHalfOfThemMendedByTheRemedy) {
    const auto mended = std::ranges::count_if(
        mutations, [](const Mutation& each) { return each.remedy != Remedy::None; });

    EXPECT_GE(mutations.size(), 40U);
    EXPECT_GE(static_cast<std::size_t>(mended), mutations.size() / 2);
}

}  // namespace
}  // namespace cortex::test
