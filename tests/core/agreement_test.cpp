// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agreement.hpp"

#include "core/model_folder.hpp"
#include "core/xml_model.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <string>

#include <gtest/gtest.h>

namespace cortex {
namespace {

using test::isValid;
using test::readTypes;
using test::XmlModel;

const std::string axisData =
    "<data name='position' kind='float' unit='rad' min='-3' max='3'/>"
    "<data name='velocity' kind='float' unit='rad/s'/>";
const std::string acceleration = "<data name='acceleration' kind='float' unit='rad/s2'/>";
const std::string torque = "<data name='torque' kind='float' unit='N.m'/>";

std::string type(const std::string& inside, const std::string& attributes = "") {
    return "<type name='Axis' " + attributes + ">" + inside + "</type>";
}

TypeModel model(const std::string& types, const std::string& rules = "") {
    XmlModel read = readTypes(types, rules);
    EXPECT_TRUE(isValid(read));
    return std::move(read.files.types);
}

std::string text(const std::vector<Disagreement>& all) {
    std::string result;
    for (const Disagreement& each : all) result += each.text() + "\n";
    return result;
}

std::string compared(const std::string& ours, const std::string& theirs) {
    return text(compare(model(ours), model(theirs)));
}

// One item of type Axis on either side.
std::string items(const std::string& ours, const std::string& theirs) {
    return compared(type("<data name='x' " + ours + "/>"), type("<data name='x' " + theirs + "/>"));
}

// The paper's example

TEST(Agreement, ExtendingATypeByAChildIsCompatible) {
    const TypeModel a = model(type(axisData + acceleration));
    const TypeModel b = model(type(axisData + acceleration) +
                              "<type name='AxisWithTorque' extends='Axis'>" + torque + "</type>");
    EXPECT_EQ(text(compare(a, b)), "");
    EXPECT_EQ(typeHash(a.at("Axis")), typeHash(b.at("Axis")));
    EXPECT_TRUE(b.isA("AxisWithTorque", "Axis"));
    for (const DataItem& item : a.at("Axis").data) {
        EXPECT_NE(b.at("AxisWithTorque").findData(item.name), nullptr) << item.name;
    }
}

TEST(Agreement, ChangingATypeIsAContradictionThatNamesTheItems) {
    const TypeModel a = model(type(axisData + acceleration)), b = model(type(axisData + torque));
    EXPECT_NE(typeHash(a.at("Axis")), typeHash(b.at("Axis")));
    const auto found = compare(a, b);
    EXPECT_EQ(text(found),
              "Axis acceleration: contradiction, ours has kind=float unit=rad/s2, theirs nothing\n"
              "Axis torque: contradiction, ours has nothing, theirs kind=float unit=N.m\n");
    EXPECT_TRUE(std::ranges::all_of(found, &Disagreement::contradiction));
}

TEST(Agreement, CorrectingALimitIsADifference) {
    const auto found = compare(model(type("<data name='position' kind='float' max='3'/>")),
                               model(type("<data name='position' kind='float' max='2.9'/>")));
    EXPECT_EQ(text(found), "Axis position: difference, ours has max=3, theirs max=2.9\n");
    EXPECT_FALSE(found.at(0).contradiction);
    EXPECT_EQ(found[0].item, "position");
}

// Each kind of disagreement

TEST(Agreement, ContradictsInShape) {
    EXPECT_EQ(items("kind='int'", "kind='float'"),
              "Axis x: contradiction, ours has kind=int, theirs kind=float\n");
    EXPECT_EQ(
        items("kind='int'", "kind='int' length='3'").find("Axis x: difference, ours has default=0"),
        0U);
    EXPECT_NE(items("kind='int'", "kind='int' length='3'")
                  .find("contradiction, ours has length=1, theirs length=3"),
              std::string::npos);
    EXPECT_EQ(items("kind='string'", "kind='string' capacity='8'"),
              "Axis x: contradiction, ours has capacity=64, theirs capacity=8\n");
    EXPECT_EQ(items("kind='float' unit='m'", "kind='float' unit='mm'"),
              "Axis x: contradiction, ours has unit=m, theirs unit=mm\n");
    EXPECT_EQ(items("kind='float' unit='m'", "kind='float'"),
              "Axis x: contradiction, ours has unit=m, theirs nothing\n");
    EXPECT_EQ(items("kind='int' constant='true'", "kind='int'"),
              "Axis x: contradiction, ours has constant=true, theirs constant=false\n");
}

TEST(Agreement, ContradictsInRoleAndParents) {
    EXPECT_EQ(compared(type("", "role='observation'"), type("", "role='active'")),
              "Axis: contradiction, ours has role=observation, theirs role=active\n");
    EXPECT_EQ(compared("<type name='P'/>" + type("", "extends='P'"), "<type name='P'/>" + type("")),
              "Axis: contradiction, ours has extends=P, theirs nothing\n");
    EXPECT_EQ(compared("<type name='P'/><type name='Q'/>" + type("", "extends='P Q'"),
                       "<type name='P'/><type name='Q'/>" + type("", "extends='Q P'")),
              "");
}

TEST(Agreement, ContradictsWhereOneNumberHasTwoLabels) {
    EXPECT_EQ(items("kind='int' labels='0:Idle 1:Jog'", "kind='int' labels='0:Idle 1:Hold'"),
              "Axis x: contradiction, ours has label 1=\"Jog\", theirs label 1=\"Hold\"\n");
    EXPECT_EQ(items("kind='int' labels='0:Idle'", "kind='int' labels='0:Idle 1:Hold'"),
              "Axis x: difference, ours has nothing, theirs label 1=\"Hold\"\n");
}

TEST(Agreement, ContradictsInCommandsAndParameters) {
    const auto commands = [](const std::string& ours, const std::string& theirs) {
        return compared(type(ours, "role='active'"), type(theirs, "role='active'"));
    };
    const std::string go = "<command name='go'/>",
                      with = "<command name='go'><request name='to' kind='int'/></command>";
    EXPECT_EQ(commands(go, ""), "Axis command go: contradiction, ours has go, theirs nothing\n");
    EXPECT_EQ(commands(go, with),
              "Axis command go: contradiction, ours has request, theirs request to\n");
    EXPECT_EQ(
        commands(with,
                 "<command name='go'><request name='to' kind='int' unit='s' max='1'/></command>"),
        "Axis command go: difference, ours has nothing, theirs request to: max=1\n"
        "Axis command go: contradiction, ours has nothing, theirs request to: unit=s\n");
    EXPECT_EQ(commands(go, "<command name='go' available='always' timeout='2'/>"),
              "Axis command go: difference, ours has available=Active, theirs available=always\n"
              "Axis command go: difference, ours has timeout=0, theirs timeout=2\n");
    EXPECT_EQ(commands("<command name='go'><response name='to' kind='int'/></command>", with)
                      .find("contradiction") != std::string::npos,
              true);
}

TEST(Agreement, DiffersInRangeDefaultSafeValueVersionAndRules) {
    EXPECT_EQ(items("kind='int' default='1'", "kind='int' default='2' safe='hold'"),
              "Axis x: difference, ours has default=1, theirs default=2\n"
              "Axis x: difference, ours has nothing, theirs safe=hold\n");
    EXPECT_EQ(compared(type("", "version='1'"), type("", "version='2'")),
              "Axis: difference, ours has version=\"1\", theirs version=\"2\"\n");
    const std::string rule =
        "<rules type='Axis'><relationship name='r' direction='input' target='Axis' max='";
    const std::string end = "'/></rules>";
    EXPECT_EQ(text(compare(model(type(""), rule + "1" + end), model(type(""), rule + "2" + end))),
              "Axis rule r: difference, ours has max=1, theirs max=2\n");
    EXPECT_EQ(text(compare(model(type("")), model(type(""), rule + "2" + end))),
              "Axis rule r: difference, ours has nothing, theirs max=2 target=Axis\n");
}

TEST(Agreement, IgnoresTypesThatOneSideLacks) {
    EXPECT_EQ(compared("<type name='A'/>", "<type name='B'/>"), "");
}

// Canonical text

TEST(CanonicalText, IsAsDocumented) {
    const TypeModel types = model(
        "<type name='Activity' role='active'/>"
        "<type name='Drive' extends='Activity' version='1.0' description='no'>"
        "<data name='b' kind='float' unit='rad.s-1' min='-1.50' max='1e1' default='0' safe='0' "
        "description='no'/>"
        "<data name='a' kind='int' labels='1:On 0:Off' settable='Active Standby'/>"
        "<data name='t' kind='string' length='2' default='x \"y z\"'/>"
        "<command name='go' long='true'><request name='z' kind='int'/><request name='a' "
        "kind='bool'/></command></type>",
        "<rules type='Drive'><relationship name='r' direction='output' target='Drive' max='1' "
        "create='Drive'/></rules>");
    EXPECT_EQ(canonicalText(types.at("Drive")),
              "1\n"
              "type Drive\n"
              " extends Activity\n"
              " role active\n"
              " version \"1.0\"\n"
              "command go\n"
              " long true\n"
              " request z\n"
              "  kind int\n"
              " request a\n"
              "  kind bool\n"
              "data a\n"
              " kind int\n"
              " label 0 \"Off\"\n"
              " label 1 \"On\"\n"
              " settable Standby Active\n"
              "data b\n"
              " max 10\n"
              " min -1.5\n"
              " safe value 0\n"
              " unit rad/s\n"
              "data t\n"
              " default \"x\" \"y z\"\n"
              " kind string\n"
              " length 2\n"
              "rule r\n"
              " create Drive\n"
              " direction output\n"
              " max 1\n"
              " target Drive\n");
}

TEST(CanonicalText, DoesNotDependOnSpellingOrderOrDefaults) {
    const TypeModel one =
        model(type("<data name='x' kind='float' unit='m/s' min='-1'/><data name='y' kind='int'/>"));
    const TypeModel other =
        model(type("<data name='y' kind='int' default='0' length='1' onLimit='clamp'/>"
                   "<data name='x' kind='float' unit='m.s-1' min='-1.0' description='text'/>",
                   "role='descriptive' writers='one' abstract='false' description='text'"));
    EXPECT_EQ(canonicalText(one.at("Axis")), canonicalText(other.at("Axis")));
}

TEST(CanonicalText, EscapesFreeText) {
    const TypeModel types =
        model(type("<data name='x' kind='string' default='a \"b\" \\ &#10;&#13;'/>"));
    EXPECT_NE(canonicalText(types.at("Axis")).find(R"( default "a \"b\" \\ \n\r")"),
              std::string::npos)
        << canonicalText(types.at("Axis"));
}

TEST(CanonicalText, TellsAHeldFromAnObservedFromAGivenSafeValue) {
    const auto hash = [](const std::string& safe) {
        return typeHash(
            model(type("<data name='x' kind='string' safe='" + safe + "'/>")).at("Axis"));
    };
    EXPECT_NE(hash("hold"), hash("observed"));
    EXPECT_NE(hash("hold"), hash("held"));
    const TypeModel observed = model(type("<data name='x' kind='float' safe='observed'/>"));
    EXPECT_NE(canonicalText(observed.at("Axis")).find(" safe observed\n"), std::string::npos);
}

TEST(CanonicalText, HashIsTheBeginningOfSha256) {
    const TypeModel types = model(type(""));
    EXPECT_EQ(canonicalText(types.at("Axis")), "1\ntype Axis\n");
    // printf '1\ntype Axis\n' | sha256sum
    EXPECT_EQ(toHex(typeHash(types.at("Axis"))), "b72ba06d31e5ec1b9b68a040d7ed365f");
}

// The shipped ontology's hashes change only on purpose: then take over the file that this test
// writes.
TEST(ShippedOntology, HasTheCommittedHashes) {
    const TypeModel types = TypeModel::load(CORTEX_SOURCE_DIR "/ontology/cortex-morphology.xml");
    std::string now;
    for (const auto& [name, each] : types.types()) now += toHex(typeHash(each)) + " " + name + "\n";
    const std::string written = CORTEX_BINARY_DIR "/ontology-hashes.txt";
    std::ofstream{written} << now;
    EXPECT_EQ(now, test::textOf(CORTEX_SOURCE_DIR "/tests/data/ontology-hashes.txt"))
        << "on purpose? cp " << written << " tests/data/";
}

// These four are in every agent. An item that one side lacks is a contradiction, so with the first
// release they are final: what the framework adds later gets simplexes of its own.
TEST(ShippedOntology, HasTheFinalTypesOfTheFramework) {
    const TypeModel types = TypeModel::load(CORTEX_SOURCE_DIR "/ontology/base.xml");
    std::string now;
    for (const char* name : {"Active", "Activity", "Agent", "Cluster"}) {
        now += canonicalText(types.at(name)) + "\n";
    }
    const std::string written = CORTEX_BINARY_DIR "/framework-types.txt";
    std::ofstream{written} << now;
    EXPECT_EQ(now, test::textOf(CORTEX_SOURCE_DIR "/tests/data/framework-types.txt"))
        << "give a new function a type of its own; see docs/architecture.md";
}

TEST(ShippedOntology, SaysOfEachHaltQuickStopAndBrakeThatItStops) {
    const TypeModel types = TypeModel::load(CORTEX_SOURCE_DIR "/ontology/cortex-morphology.xml");
    std::map<std::string, int> found;
    for (const auto& [name, type] : types.types()) {
        for (const char* each : {"halt", "quickStop", "brake"}) {
            const auto* command = type.findCommand(each);
            if (command == nullptr) continue;
            ++found[each];
            EXPECT_TRUE(command->stops) << name << '.' << each;
        }
    }
    EXPECT_EQ(found.size(), 3U);
}

TEST(HashOf, IsTheFirstHalfOfSha256) {
    EXPECT_EQ(toHex(hashOf("abc")), "ba7816bf8f01cfea414140de5dae2223");
}

}  // namespace
}  // namespace cortex
