// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/model_files.hpp"

#include "core/model_folder.hpp"
#include "core/xml_model.hpp"

#include <algorithm>
#include <cstdlib>

#include <gtest/gtest.h>

namespace cortex {
namespace {

namespace fs = std::filesystem;
using test::finds;
using test::isValid;
using test::readFiles;
using test::XmlModel;

XmlModel readOne(const std::string& text) { return readFiles({{"f.xml", text}}); }

// Sets a variable of the environment for one test.
class Environment {
public:
    Environment(const char* name, const std::string& value) : name_{name} {
        if (const char* old = std::getenv(name)) before_ = old;
        setenv(name, value.c_str(), 1);
    }
    ~Environment() { setenv(name_, before_.c_str(), 1); }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

private:
    const char* name_;
    std::string before_;
};

// Systems

TEST(ModelFiles, ReadsASystemWithItsTypes) {
    const XmlModel model = readFiles(
        {{"s.xml", R"(<system name="plant"><ontology file="t.xml"/><morphology file="m.xml"/>
  <cluster name="robot" frequency="1000" overflow="skip"/>
  <simplex path="/a" type="A" every="3" phase="2"><relate rule="r" to="/b" delayed="true"/>
    <relate rule="r" to="/c" remote="true"/><set data="x" value=" 1 2 "/></simplex>
  <simplex path="/b" type="A"/></system>)"},
         {"t.xml", "<ontology name='t'><type name='A'/></ontology>"},
         {"m.xml",
          "<morphology name='m'><rules type='A'>"
          "<relationship name='r' direction='input' target='A'/></rules></morphology>"}});
    ASSERT_TRUE(isValid(model));
    EXPECT_TRUE(model.files.hasSystem);
    EXPECT_EQ(model.files.files.size(), 3U);
    const SystemDescription& system = model.files.system;
    EXPECT_EQ(system.name, "plant");
    ASSERT_EQ(system.clusters.size(), 1U);
    EXPECT_EQ(system.clusters[0].name, "robot");
    EXPECT_EQ(system.clusters[0].attributes.at("frequency"), "1000");
    ASSERT_EQ(system.simplexes.size(), 2U);
    const auto& a = system.simplexes[0];
    EXPECT_EQ(a.path + a.type, "/aA");
    EXPECT_EQ(a.every, 3);
    EXPECT_EQ(a.phase, 2);
    ASSERT_EQ(a.relates.size(), 2U);
    EXPECT_TRUE(a.relates[0].delayed && !a.relates[0].remote);
    EXPECT_TRUE(a.relates[1].remote && !a.relates[1].delayed);
    EXPECT_EQ(a.relates[1].to, "/c");
    EXPECT_EQ(a.settings.at(0).value, " 1 2 ");
    EXPECT_EQ(a.settings[0].place.line, 4);
    EXPECT_EQ(system.simplexes[1].phase, -1);
    EXPECT_EQ(system.simplexes[1].place.line, 5);
}

TEST(ModelFiles, RefusesAPhaseThatNeverComes) {
    EXPECT_TRUE(finds(
        readOne("<system name='s'>\n<simplex path='/a' type='A' every='2' phase='2'/></system>"),
        "phase-range", "/a", 2, "from 0 to 1"));
    EXPECT_TRUE(
        isValid(readOne("<system name='s'><simplex path='/a' type='A' phase='0'/></system>")));
}

TEST(ModelFiles, ChecksTheFormOfClusterAttributes) {
    for (const char* attribute : {"frequency='nan'",
                                  "frequency='1e6'",
                                  "trigger='timer'",
                                  "triggerFrom='tcp:1'",
                                  "triggerFrom='udp:0'",
                                  "triggerFrom='udp:host:5005'",
                                  "triggerFrom='fd:-1'",
                                  "triggerFrom='fd:1:2'",
                                  "threads='0'",
                                  "threads='300'",
                                  "priority='100'",
                                  "cpus='a'",
                                  "cpus=''",
                                  "acrossCaches='1 2'",
                                  "lockMemory='yes'",
                                  "keepCpusAwake='no'",
                                  "overflow='warn'",
                                  "catchUpCycles='-1'",
                                  "warnDuty='-1'",
                                  "warnLateness='-1'",
                                  "haltLateness='late'",
                                  "watchdogPeriods='0'",
                                  "triggerTimeout='0'",
                                  "stopTimeout='0'",
                                  "control='maybe'",
                                  "imageReaders='many'"}) {
        EXPECT_TRUE(finds(readOne("<system name='s'>\n<cluster name='c' " + std::string{attribute} +
                                  "/></system>"),
                          "attribute-value", "/c", 2))
            << attribute;
    }
}

TEST(ModelFiles, ReadsWhereTheTicksOfAnExternalTriggerComeFrom) {
    for (const char* from : {"udp:5005", "udp:127.0.0.1:5005", "fd:3"}) {
        const XmlModel model = readOne(
            "<system name='s'><cluster name='c' frequency='100' trigger='external' triggerFrom='" +
            std::string{from} + "'/></system>");
        ASSERT_TRUE(isValid(model)) << from;
        EXPECT_EQ(model.files.system.clusters[0].attributes.at("triggerFrom"), from);
    }
}

TEST(ModelFiles, SaysAllThatAnExternalTriggerLacksAndWhatAClockDoesNotTake) {
    const XmlModel bare =
        readOne("<system name='s'>\n<cluster name='c' trigger='external'/></system>");
    ASSERT_EQ(bare.report.findings.size(), 2U);
    EXPECT_EQ(bare.report.findings[0].text() + "\n" + bare.report.findings[1].text(),
              "/c: trigger=\"external\" needs triggerFrom [f.xml:2]; write where its ticks come "
              "from: triggerFrom=\"udp:5005\" or \"fd:3\"\n"
              "/c: trigger=\"external\" needs frequency [f.xml:2]; write how often its ticks come: "
              "frequency=\"1000\"");
    EXPECT_TRUE(finds(readOne("<system name='s'>\n<cluster name='c' triggerFrom='fd:3'/></system>"),
                      "attribute-value", "/c", 2, "trigger=\"external\""));
}

TEST(ModelFiles, RefusesWhatASystemGivesTwice) {
    EXPECT_TRUE(finds(readOne("<system name='s'><simplex path='/a' type='A'/>\n<simplex path='/a' "
                              "type='B'/></system>"),
                      "duplicate-path", "/a", 2, "first at f.xml:1"));
    EXPECT_TRUE(finds(readOne("<system name='s'><cluster name='c'/>\n<cluster name='c'/></system>"),
                      "duplicate-cluster", "/c", 2, "first at f.xml:1"));
    EXPECT_TRUE(
        finds(readOne("<system name='s'><simplex path='/a' type='A'><set data='x' value='1'/>\n"
                      "<set data='x' value='2'/></simplex></system>"),
              "duplicate-setting", "/a", 2, "first at f.xml:1"));
}

TEST(ModelFiles, JoinsSeveralSystems) {
    const test::ModelFolder folder;
    const fs::path files[] = {
        folder.write("a.xml", "<system name='one'><simplex path='/a' type='A'/></system>"),
        folder.write("b.xml", "<system name='two'><simplex path='/b' type='A'/></system>")};
    Report report;
    const ModelFiles read = readModelFiles(files, report);
    EXPECT_TRUE(report.ok()) << report.text();
    EXPECT_EQ(read.system.name, "one");
    EXPECT_EQ(read.system.simplexes.size(), 2U);
}

// Finding files

TEST(ModelFiles, LooksBesideTheIncludingFileThenInTheSearchPath) {
    const test::ModelFolder folder, library;
    fs::create_directory(folder.path() / "sub");
    folder.write("sub/near.xml", "<ontology name='near'><type name='Near'/></ontology>");
    library.write("near.xml", "<ontology name='far'><type name='Wrong'/></ontology>");
    library.write("far.xml", "<ontology name='far'><type name='Far'/></ontology>");
    const fs::path first = folder.write(
        "sub/m.xml",
        "<morphology name='m'><include file='near.xml'/><include file='far.xml'/></morphology>");
    const Environment path{"CORTEX_PATH", "/nonexistent::" + library.path().string()};
    Report report;
    const ModelFiles read = readModelFiles(std::span{&first, 1}, report);
    ASSERT_TRUE(report.ok()) << report.text();
    EXPECT_NE(read.types.find("Near"), nullptr);
    EXPECT_NE(read.types.find("Far"), nullptr);
    EXPECT_EQ(read.types.find("Wrong"), nullptr);
    const fs::path named{"far.xml"};
    EXPECT_NE(readModelFiles(std::span{&named, 1}, report).types.find("Far"), nullptr);
}

TEST(ModelFiles, SaysWhereItLookedForAMissingFile) {
    const Environment path{"CORTEX_PATH", "/somewhere/else"};
    const XmlModel model = readOne("<ontology name='t'>\n<include file='gone.xml'/></ontology>");
    EXPECT_TRUE(
        finds(model, "file-missing", "", 2, "looked for gone.xml, /somewhere/else/gone.xml, "));
    EXPECT_NE(model.text().find("share/cortex/gone.xml"), std::string::npos);
    EXPECT_EQ(model.report.findings[0].place.file, "f.xml");
}

TEST(ModelFiles, RefusesWhatIsNoFile) {
    const test::ModelFolder folder;
    for (const fs::path& file :
         {folder.path(), fs::path{"/dev/null"}, fs::path{"/no/such/file.xml"}}) {
        Report report;
        readModelFiles(std::span{&file, 1}, report);
        ASSERT_EQ(report.findings.size(), 1U) << file;
        EXPECT_EQ(report.findings[0].rule, "file-missing") << report.text();
    }
}

TEST(ModelFiles, ReadsAFileIncludedTwiceOnce) {
    const XmlModel model =
        readFiles({{"a.xml",
                    "<ontology name='a'><include file='b.xml'/><include file='c.xml'/>"
                    "<include file='./b.xml'/></ontology>"},
                   {"b.xml", "<ontology name='b'><type name='B'/></ontology>"},
                   {"c.xml", "<ontology name='c'><include file='b.xml'/></ontology>"}});
    ASSERT_TRUE(isValid(model));
    EXPECT_EQ(model.files.files.size(), 3U);
}

TEST(ModelFiles, PrintsALoopOfIncludes) {
    const XmlModel model =
        readFiles({{"a.xml", "<ontology name='a'><include file='b.xml'/></ontology>"},
                   {"b.xml", "<ontology name='b'><include file='c.xml'/></ontology>"},
                   {"c.xml", "<ontology name='c'>\n<include file='a.xml'/></ontology>"}});
    EXPECT_TRUE(finds(model, "include-loop", "", 2, "a.xml → b.xml → c.xml → a.xml"));
    EXPECT_EQ(model.report.findings[0].place.file, "c.xml");
    EXPECT_TRUE(finds(readOne("<ontology name='a'><include file='f.xml'/></ontology>"),
                      "include-loop", "", 1));
}

TEST(ModelFiles, RefusesAFileOfTheWrongKind) {
    const auto including = [](const std::string& how, const std::string& what) {
        return readFiles({{"s.xml", "<system name='s'>\n<" + how + " file='o.xml'/></system>"},
                          {"o.xml", "<" + what + " name='o'/>"}});
    };
    EXPECT_TRUE(
        finds(including("ontology", "morphology"), "file-kind", "", 2, "wanted is ontology"));
    EXPECT_TRUE(finds(including("morphology", "ontology"), "file-kind", "", 2, "<ontology file="));
    EXPECT_TRUE(finds(including("morphology", "system"), "file-kind", "", 2, "include it"));
    EXPECT_TRUE(isValid(including("include", "morphology")));
    EXPECT_TRUE(isValid(including("include", "system")));
    const XmlModel twice = readFiles({{"s.xml",
                                       "<system name='s'><ontology file='o.xml'/>\n"
                                       "<morphology file='o.xml'/></system>"},
                                      {"o.xml", "<ontology name='o'/>"}});
    EXPECT_TRUE(finds(twice, "file-kind", "", 2));
}

TEST(ModelFiles, RefusesMoreThan256Files) {
    std::vector<std::pair<std::string, std::string>> files{{"f.xml", ""}};
    std::string text = "<ontology name='t'>";
    for (int i = 0; i < 300; ++i) {
        const std::string name = "i" + std::to_string(i) + ".xml";
        text += "\n<include file='" + name + "'/>";
        files.emplace_back(name, "<ontology name='i'/>");
    }
    files[0].second = text + "</ontology>";
    const XmlModel model = readFiles(files);
    EXPECT_TRUE(finds(model, "file-count", "", 257));
    EXPECT_EQ(model.files.files.size(), 256U);
}

// Structure of the XML

TEST(ModelFiles, NamesTheNearestElementAndAttribute) {
    EXPECT_TRUE(finds(readOne("<ontology name='t'>\n<tpye name='A'/></ontology>"),
                      "unknown-element", "", 2, "nearest of: type"));
    EXPECT_TRUE(finds(readOne("<ontology name='t'><type name='A'><data name='x' "
                              "kind='int'\nminimum='0'/></type></ontology>"),
                      "unknown-attribute", "A", 2, "nearest of: min"));
    EXPECT_TRUE(
        finds(readOne("<ontlogy name='t'/>"), "unknown-element", "", 1, "nearest of: ontology"));
    EXPECT_TRUE(finds(readOne("<system name='s'>\n<cluster name='c'><x/></cluster></system>"),
                      "unknown-element", "/c", 2, "has no elements"));
}

TEST(ModelFiles, RefusesTextAndRepeatedDescriptions) {
    EXPECT_TRUE(finds(readOne("<ontology name='t'>\n<type name='A'>text</type></ontology>"),
                      "xml-text", "A", 2));
    EXPECT_TRUE(finds(readOne("<ontology name='t'><type name='A' "
                              "description='a'>\n<description>b</description></type>"
                              "</ontology>"),
                      "repeated-element", "A", 2));
    EXPECT_TRUE(finds(
        readOne(
            "<ontology name='t'><type name='A'><description>b<b/></description></type></ontology>"),
        "unknown-element", "A", 1, "plain text"));
}

TEST(ModelFiles, AcceptsWhatEditorsWriteAtTheRoot) {
    EXPECT_TRUE(isValid(
        readOne("\xEF\xBB\xBF<?xml version='1.0' encoding='utf-8'?>\n<!-- c --><ontology name='t' "
                "xmlns:xsi='http://www.w3.org/2001/XMLSchema-instance' "
                "xsi:noNamespaceSchemaLocation='ontology.xsd'/>")));
}

TEST(ModelFiles, GoesOnAfterErrors) {
    const XmlModel model = readOne(
        "<ontology name='t' colour='red'>\n<type name='A' extends='Gone'>\n<data kind='int'/>\n"
        "<data name='x' kind='float' unit='quux' min='2' max='1'/></type>\n"
        "<type name='A'/>\n<rubbish/></ontology>");
    std::vector<std::string> rules;
    for (const Finding& each : model.report.findings) {
        rules.push_back(each.rule + " " + std::to_string(each.place.line));
        EXPECT_FALSE(each.remedy.empty()) << each.text();
    }
    std::ranges::sort(rules);
    EXPECT_EQ(rules, (std::vector<std::string>{"duplicate-type 5", "missing-attribute 3",
                                               "range-empty 4", "unit 4", "unknown-attribute 1",
                                               "unknown-element 6", "unknown-parent 2"}));
    EXPECT_NE(model.type("A").findData("x"), nullptr);
}

// The samples that also tests/schema_test.sh reads; names are those of the rules broken.
TEST(ModelFiles, AgreesWithTheSchemasOnTheSamples) {
    std::size_t count = 0;
    for (const auto& entry :
         fs::directory_iterator{CORTEX_SOURCE_DIR "/tests/data/schema/invalid"}) {
        const fs::path file = entry.path();
        const std::string stem = file.stem().string();
        Report report;
        readModelFiles(std::span{&file, 1}, report);
        ASSERT_EQ(report.findings.size(), 1U) << file << "\n" << report.text();
        EXPECT_EQ(report.findings[0].rule, stem.substr(0, stem.find('.'))) << report.text();
        EXPECT_EQ(report.findings[0].place.file, file.string());
        EXPECT_GE(report.findings[0].place.line, 3);
        ++count;
    }
    EXPECT_GE(count, 40U);
    for (const auto& entry : fs::directory_iterator{CORTEX_SOURCE_DIR "/tests/data/schema/valid"}) {
        const fs::path file = entry.path();
        Report report;
        readModelFiles(std::span{&file, 1}, report);
        EXPECT_TRUE(report.findings.empty()) << report.text();
    }
}

}  // namespace
}  // namespace cortex
