// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/model_files.hpp"

#include "core/model_folder.hpp"
#include "core/xml_model.hpp"
#include "support/share.hpp"

#include <algorithm>
#include <fstream>
#include <random>

#include <gtest/gtest.h>

// Files that are malformed or made to do harm: a clear error each, in bounded time and memory.
namespace cortex {
namespace {

namespace fs = std::filesystem;
using test::finds;
using test::isValid;
using test::share;
using test::XmlModel;

XmlModel readOne(const std::string& text) { return test::readFiles({{"f.xml", text}}); }

const char* const smallModel = R"(<?xml version="1.0"?>
<ontology name="t"><!-- é --><type name="A" role="active"><data name="x" kind="float" unit="m" min="-1" max="1"
 default="0.5" labels=""/><command name="c"><request name="r" kind="int"/></command></type></ontology>)";

TEST(HostileXml, EntitiesAreNotExpanded) {
    const std::string bomb =
        "<!DOCTYPE b [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;\">]>\n"
        "<ontology name='&b;'/>";
    EXPECT_TRUE(finds(readOne(bomb), "xml-doctype", "", 1));
    EXPECT_TRUE(
        finds(readOne("<ontology name='t'>\n<!ENTITY a 'x'></ontology>"), "xml-doctype", "", 2));
    EXPECT_TRUE(finds(readOne("<ontology name='t'>\n<type name='&a;'/></ontology>"), "xml-entity",
                      "", 2, "'&a'"));
    for (const char* text :
         {"&", "& ", "&;", "&#0;", "&#xD800;", "&#x110000;", "&#99999999999;", "&#x;", "&#1;"}) {
        EXPECT_TRUE(
            finds(readOne("<ontology name='t" + std::string{text} + "'/>"), "xml-entity", "", 1))
            << text;
    }
    EXPECT_TRUE(
        isValid(readOne("<ontology name='&lt;&gt;&amp;&quot;&apos;&#176;&#x1F600;&#10;'/>")));
    EXPECT_TRUE(isValid(readOne("<ontology name='t'><!-- &a; <!DOCTYPE x> --></ontology>")));
}

TEST(HostileXml, MarkupInAttributesHidesNothing) {
    EXPECT_TRUE(finds(readOne("<ontology name='<!--'><!DOCTYPE x><x a='-->'/></ontology>"),
                      "xml-syntax", "", 1));
    EXPECT_TRUE(
        finds(readOne("<?xml <!-- ?><!DOCTYPE x><ontology name='-->'/>"), "xml-doctype", "", 1));
}

TEST(HostileXml, DeepNestingIsRefused) {
    for (const int depth : {33, 499, 600, 10'000, 200'000}) {
        std::string text;
        for (int i = 0; i < depth; ++i) text += "<a>";
        const XmlModel model = readOne(text);
        ASSERT_FALSE(model.report.ok());
    }
    std::string closed = "<ontology name='t'>";
    for (int i = 0; i < 40; ++i) closed += "<type name='A'>";
    for (int i = 0; i < 40; ++i) closed += "</type>";
    EXPECT_TRUE(finds(readOne(closed + "</ontology>"), "xml-nesting", "", 1));
    std::string deep;
    for (int i = 0; i < 10'000; ++i) deep += "<a>";
    for (int i = 0; i < 10'000; ++i) deep += "</a>";
    EXPECT_TRUE(finds(readOne(deep), "xml-nesting", "", 1));
}

TEST(HostileXml, IsUtf8) {
    EXPECT_TRUE(finds(readOne("<ontology name='\xFF'/>"), "xml-encoding", "", 1));
    EXPECT_TRUE(
        finds(readOne(std::string{"<ontology name='t'/>\0<x/>", 25}), "xml-encoding", "", 1));
    EXPECT_TRUE(finds(readOne(std::string{"\xFF\xFE<\0o\0", 6}), "xml-encoding", "", 1));
    EXPECT_TRUE(finds(readOne("<?xml version='1.0' encoding='ISO-8859-1'?><ontology name='t'/>"),
                      "xml-encoding", "", 1, "iso-8859-1"));
}

TEST(HostileXml, IsWellFormed) {
    for (const char* text :
         {"", "   ", "text", "<", "<ontology", "<ontology name='t'>",
          "<ontology name='t'></ontolog>", "<ontology name='t' name='u'/>", "<ontology name=t/>",
          "<ontology name='t'/><ontology name='u'/>", "<ontology name='t'/>text", "<!-- open",
          "<ontology name='t'><![CDATA[ open </ontology>", "<ontology name='t'><a></ontology></a>",
          "<!-- only -->", "</ontology>", "<?xml version='1.0'?>",
          "<ontology name='t'/><?xml version='1.0'?>", "<ontology 1='x'/>"}) {
        const XmlModel model = readOne(text);
        EXPECT_TRUE(finds(model, "xml-syntax", "",
                          model.report.findings.empty() ? 0 : model.report.findings[0].place.line))
            << text;
        EXPECT_GE(model.report.findings[0].place.line, 1) << text;
    }
}

TEST(HostileXml, HasBoundedElementsAndAttributes) {
    std::string many = "<ontology name='t'>";
    for (int i = 0; i < 250'001; ++i) many += "<a/>";
    EXPECT_TRUE(finds(readOne(many + "</ontology>"), "xml-elements", "", 1));
    std::string wide = "<ontology name='t'";
    for (int i = 0; i < 100'000; ++i) wide += " a" + std::to_string(i) + "='1'";
    EXPECT_TRUE(finds(readOne(wide + "/>"), "xml-elements", "", 1, "too many attributes"));
}

TEST(HostileXml, HugeFilesAreNotRead) {
    const test::ModelFolder folder;
    const fs::path file = folder.write("huge.xml", "<ontology name='t'>");
    {
        std::ofstream stream{file, std::ios::app};
        const std::string block(1U << 20U, ' ');
        for (int i = 0; i < 100; ++i) stream << block;
        stream << "</ontology>";
    }
    ASSERT_GT(fs::file_size(file), 100U << 20U);
    Report report;
    readModelFiles(std::span{&file, 1}, report);
    ASSERT_EQ(report.findings.size(), 1U);
    EXPECT_EQ(report.findings[0].rule, "file-size");
    EXPECT_EQ(report.findings[0].place.file, file.string());
}

TEST(HostileXml, LongNamesAndValuesAreCutInMessages) {
    const std::string name(1'000'000, 'x');
    for (const std::string& text :
         {"<" + name + " name='t'/>", "<ontology name='t'><" + name + "/></ontology>",
          "<ontology name='t'><type name='A'><data name='x' kind='" + name +
              "'/></type></ontology>",
          "<ontology name='t'><type name='A' extends='" + name + "'/></ontology>",
          "<ontology name='t'><type name='" + name + "'/></ontology>",
          "<ontology name='t'><include file='" + name + "'/></ontology>",
          "<ontology name='t' " + name + "='1'/>"}) {
        const XmlModel model = readOne(text);
        ASSERT_FALSE(model.report.ok());
        for (const Finding& each : model.report.findings) {
            EXPECT_LT(each.message.size() + each.remedy.size() + each.path.size(), 4000U)
                << each.rule;
        }
    }
}

TEST(HostileXml, ManyUnknownNamesCostLittle) {
    const std::size_t names = share(15'000U);
    std::string text = "<ontology name='t'>";
    for (std::size_t i = 0; i < names; ++i) {
        text +=
            "<type name='Type" + std::to_string(i) + "' extends='Tipe" + std::to_string(i) + "'/>";
    }
    const XmlModel model = readOne(text + "</ontology>");
    EXPECT_EQ(model.report.findings.size(), names);
    const auto isNear = [](const Finding& each) { return each.remedy.starts_with("nearest"); };
    EXPECT_EQ(std::ranges::count_if(model.report.findings, isNear), 100)
        << "near ones are sought for the first only";
}

TEST(HostileXml, TruncatedAnywhereIsRefused) {
    const std::string whole = smallModel;
    for (std::size_t size = 0; size + 1 < whole.size(); ++size) {
        const XmlModel model = readOne(whole.substr(0, size));
        EXPECT_FALSE(model.report.ok()) << size;
        for (const Finding& each : model.report.findings)
            EXPECT_FALSE(each.remedy.empty()) << each.text();
    }
}

// Whatever is changed: no crash, every finding has place and remedy, the same file the same report.
TEST(HostileXml, RandomMutationsAreReadOrRefusedInWords) {
    const std::string whole =
        test::textOf(CORTEX_SOURCE_DIR "/ontology/base.xml").substr(0, 3000) + "</ontology>";
    const std::string letters = "<>/='\"& \n!?-[]aAxX019.*:\x80\xFF";
    std::mt19937 random{42};
    const auto below = [&](std::size_t end) {
        return std::uniform_int_distribution<std::size_t>{0, end - 1}(random);
    };
    for (int round = 0; round < 400; ++round) {
        std::string text = whole;
        for (std::size_t i = below(8) + 1; i > 0; --i) {
            const std::size_t at = below(text.size());
            switch (below(4)) {
                case 0:
                    text[at] = letters[below(letters.size())];
                    break;
                case 1:
                    text.erase(at, below(40));
                    break;
                case 2:
                    text.insert(at, 1, letters[below(letters.size())]);
                    break;
                default:
                    text.insert(at, text.substr(below(text.size()), below(200)));
                    break;
            }
        }
        const XmlModel model = readOne(text);
        for (const Finding& each : model.report.findings) {
            EXPECT_FALSE(each.remedy.empty()) << each.text();
            EXPECT_FALSE(each.rule.empty()) << each.text();
            EXPECT_EQ(each.place.file, "f.xml") << each.text();
        }
        EXPECT_EQ(readOne(text).text(), model.text());
    }
}

}  // namespace
}  // namespace cortex
