// SPDX-License-Identifier: Apache-2.0
#include "core/xml_model.hpp"

#include <gtest/gtest.h>

// What types say about commands: alone, narrowed by children, and joined from several parents.
namespace cortex {
namespace {

using test::finds;
using test::isValid;
using test::readTypes;
using test::XmlModel;

// Line 1: Activity; 2: P; 3: Q; 4: A, child of P; 5: B, child of P and Q.
XmlModel commands(const std::string& p, const std::string& a = "", const std::string& q = "",
                  const std::string& b = "") {
    return readTypes("<type name='Activity' role='active'/>\n<type name='P' extends='Activity'>" +
                     p + "</type>\n<type name='Q' extends='Activity'>" + q +
                     "</type>\n<type name='A' extends='P'>" + a +
                     "</type>\n<type name='B' extends='P Q'>" + b + "</type>");
}

std::string command(const std::string& attributes, const std::string& inside = "") {
    return "<command name='go' " + attributes + ">" + inside + "</command>";
}

const Command& go(const XmlModel& model, const std::string& type) {
    return *model.type(type).findCommand("go");
}

TEST(Command, ReadsEveryAttribute) {
    const XmlModel model = commands(
        command("available='Standby Active' long='true' timeout='2.5' confirm='true' "
                "stops='true' repeated='true' "
                "onBusy='replace' onInputLost='continue' onSenderLost='cancel' description='d'",
                "<request name='to' kind='float' unit='m' max='1' default='0.5'/>"
                "<request name='how' kind='string' capacity='8'/>"
                "<response name='error' kind='int' labels='0:None'/>"));
    ASSERT_TRUE(isValid(model));
    const Command& c = go(model, "A");
    EXPECT_EQ(c.available.text(), "Standby Active");
    EXPECT_TRUE(c.isLong && c.confirm && c.stops && c.repeated);
    EXPECT_EQ(c.timeout, 2.5);
    EXPECT_EQ(c.onBusy, OnBusy::Replace);
    EXPECT_EQ(c.onInputLost, OnInputLost::Continue);
    EXPECT_EQ(c.onSenderLost, OnSenderLost::Cancel);
    ASSERT_EQ(c.request.size(), 2U);
    EXPECT_EQ(c.request[0].name, "to");
    EXPECT_EQ(c.request[0].initial, Value{std::vector<double>{0.5}});
    EXPECT_EQ(c.response[0].labels.at(0), "None");
    EXPECT_EQ(c.definedBy, "P");
    EXPECT_EQ(c.place.line, 2);
}

TEST(Command, IsOnlyForActiveTypes) {
    EXPECT_TRUE(
        finds(readTypes("<type name='A'>\n<command name='go'/></type>"), "command-role", "A", 2));
    EXPECT_TRUE(finds(readTypes("<type name='A' role='observation'>\n<command name='go'/></type>"),
                      "command-role", "A", 2));
}

TEST(Command, ThatIsLongNeedsAnActivity) {
    EXPECT_TRUE(
        finds(readTypes("<type name='Activity' role='active'/>"
                        "<type name='A' role='active'>\n<command name='go' long='true'/></type>"),
              "long-activity", "A", 2, "extend Activity"));
    EXPECT_TRUE(
        finds(readTypes("<type name='A' role='active'>\n<command name='go' long='true'/></type>"),
              "long-activity", "A", 2, "include base.xml"));
}

TEST(Command, CannotBeCalledLikeOneThatIsBuiltIn) {
    EXPECT_TRUE(finds(commands("<command name='set'/>"), "reserved-name", "P", 2, "settable="));
    EXPECT_TRUE(finds(commands("<command name='cancel'/>"), "reserved-name", "P", 2,
                      "take another name; a long command can be cancelled"));
}

TEST(Command, IsGivenOnceWithEachParameterOnce) {
    EXPECT_TRUE(finds(commands(command("") + command("")), "duplicate-command", "P", 2));
    EXPECT_TRUE(
        finds(commands(command("", "<request name='x' kind='int'/><request name='x' kind='int'/>")),
              "duplicate-parameter", "P", 2));
    EXPECT_TRUE(isValid(
        commands(command("", "<request name='x' kind='int'/><response name='x' kind='int'/>"))));
}

TEST(Command, HasNoAttributesOfDataInItsParameters) {
    EXPECT_TRUE(finds(commands(command("", "<request name='x' kind='int' settable='always'/>")),
                      "unknown-attribute", "P", 2));
    TypeDeclaration type;
    type.name = "P";
    type.role = Role::Active;
    type.commands.emplace_back();
    type.commands[0].name = "go";
    type.commands[0].request.emplace_back();
    type.commands[0].request[0].name = "x";
    type.commands[0].request[0].measured = true;
    Report report;
    TypeModel::build({type}, report);
    ASSERT_EQ(report.findings.size(), 1U);
    EXPECT_EQ(report.findings[0].rule, "parameter-attribute");
}

TEST(Command, ChecksItsParametersLikeData) {
    EXPECT_TRUE(finds(commands(command("", "<request name='x' kind='int' default='a'/>")),
                      "default-kind", "P", 2, "command 'go': request 'x'"));
    EXPECT_TRUE(finds(commands(command("", "<request name='x'/>")), "kind-missing", "P", 2));
}

TEST(Command, HasBoundedRecords) {
    EXPECT_TRUE(isValid(commands(command("", "<request name='x' kind='float' length='512'/>"))));
    EXPECT_TRUE(finds(commands(command("", "<request name='x' kind='float' length='513'/>")),
                      "record-size", "P", 2, "4104 octets"));
    EXPECT_TRUE(finds(commands(command("", "<response name='x' kind='string' capacity='4096'/>")),
                      "record-size", "P", 2));
    EXPECT_TRUE(isValid(commands(command("", "<request name='x' kind='bool' length='4096'/>"))));
}

TEST(Command, HasATimeoutThatIsATime) {
    EXPECT_TRUE(finds(commands(command("timeout='-1'")), "timeout", "P", 2));
}

// Narrowing

TEST(CommandNarrowing, KeepsWhatIsNotStatedAndTightensTheRest) {
    const XmlModel model =
        commands(command("available='Standby Active'",
                         "<request name='x' kind='int' max='9'/><response name='y' kind='int'/>"),
                 command("available='Standby' confirm='true' timeout='1' onBusy='replace' "
                         "onSenderLost='cancel' description='d'",
                         "<request name='x' max='5'/>"));
    ASSERT_TRUE(isValid(model));
    const Command& c = go(model, "A");
    EXPECT_EQ(c.available.text(), "Standby");
    EXPECT_TRUE(c.confirm);
    EXPECT_EQ(c.timeout, 1);
    EXPECT_EQ(c.onBusy, OnBusy::Replace);
    EXPECT_EQ(c.onSenderLost, OnSenderLost::Cancel);
    EXPECT_EQ(c.request[0].max, Number{std::int64_t{5}});
    EXPECT_EQ(c.response.size(), 1U);
    EXPECT_EQ(c.definedBy, "A");
}

TEST(CommandNarrowing, NeverWidensOrChangesTheRecord) {
    EXPECT_TRUE(finds(commands(command(""), command("available='always'")), "availability-widened",
                      "A", 4, "write available=\"Active\""));
    EXPECT_TRUE(
        finds(commands(command("long='true'"), command("long='false'")), "long-changed", "A", 4));
    EXPECT_TRUE(finds(commands(command("confirm='true'"), command("confirm='false'")),
                      "confirm-loosened", "A", 4));
    EXPECT_TRUE(finds(commands(command(""), command("stops='true'")), "stops-loosened", "A", 4));
    EXPECT_TRUE(
        finds(commands(command(""), command("repeated='true'")), "repeated-loosened", "A", 4));
    EXPECT_TRUE(finds(commands(command(""), command("", "<request name='x' kind='int'/>")),
                      "parameters-changed", "A", 4));
    EXPECT_TRUE(finds(commands(command("", "<request name='x' kind='int'/>"),
                               command("", "<request name='x' kind='float'/>")),
                      "kind-changed", "A", 4));
}

TEST(CommandNarrowing, MayAskForControlOfWhatOnlyStops) {
    const XmlModel model = commands(command("stops='true'"), command("stops='false'"));
    ASSERT_TRUE(isValid(model));
    EXPECT_FALSE(go(model, "A").stops);
}

// Several parents

TEST(CommandIntersection, OnlyStopsWhereBothDo) {
    EXPECT_FALSE(go(commands(command("stops='true'"), "", command("")), "B").stops);
    EXPECT_TRUE(go(commands(command("stops='true'"), "", command("stops='true'")), "B").stops);
}

TEST(CommandIntersection, IsAvailableWhereBothAllow) {
    const XmlModel model = commands(
        command("available='Standby Active'", "<request name='x' kind='int' max='9'/>"), "",
        command("available='Active Fault' confirm='true' description='q'",
                "<request name='x' kind='int' min='2'/>"));
    ASSERT_TRUE(isValid(model));
    const Command& c = go(model, "B");
    EXPECT_EQ(c.available.text(), "Active");
    EXPECT_TRUE(c.confirm);
    EXPECT_EQ(c.request[0].min, Number{std::int64_t{2}});
    EXPECT_EQ(c.request[0].max, Number{std::int64_t{9}});
    EXPECT_EQ(c.description, "q");
}

TEST(CommandIntersection, ThatIsEmptyNamesBothParents) {
    EXPECT_TRUE(finds(commands(command("available='Standby'"), "", command("available='Fault'")),
                      "intersection-empty", "B", 5,
                      "available 'Standby' from 'P' and 'Fault' from 'Q'"));
    EXPECT_TRUE(
        finds(commands(command("long='true'"), "", command("")), "intersection-empty", "B", 5));
    EXPECT_TRUE(finds(commands(command("", "<request name='x' kind='int'/>"), "", command("")),
                      "intersection-empty", "B", 5, "request 'x' from 'P' and '' from 'Q'"));
}

TEST(CommandIntersection, LeavesWhatDiffersToTheChild) {
    const std::string p = command("timeout='1' onBusy='replace'"),
                      q = command("onSenderLost='cancel' onInputLost='continue'");
    const XmlModel open = commands(p, "", q);
    EXPECT_EQ(open.report.findings.size(), 4U) << open.text();
    for (const Finding& each : open.report.findings) EXPECT_EQ(each.rule, "restate");
    EXPECT_TRUE(isValid(commands(
        p, "", q,
        command("timeout='2' onBusy='reject' onInputLost='fail' onSenderLost='continue'"))));
}

}  // namespace
}  // namespace cortex
