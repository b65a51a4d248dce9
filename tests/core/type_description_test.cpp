// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/type_description.hpp"

#include "cortex/core/agent.hpp"
#include "cortex/core/make_structure.hpp"
#include "cortex/core/simplex_tree.hpp"

#include "core/xml_model.hpp"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex {
namespace {

using test::isValid;
using test::readTypes;
using test::XmlModel;

std::vector<TypeDescription> describeAll(const TypeModel& model) {
    std::vector<TypeDescription> described;
    for (const auto& [name, type] : model.types()) described.push_back(describe(type));
    return described;
}

TypeDescription& in(std::vector<TypeDescription>& described, const std::string& type) {
    return *std::ranges::find(described, type, &TypeDescription::name);
}

template <class Item>
const Item& named(const std::vector<Item>& items, const std::string& name) {
    return *std::ranges::find(items, name, &Item::name);
}

std::string text(const std::vector<DescribedAttribute>& attributes) {
    std::string result;
    for (const auto& each : attributes) result += each.name + "='" + each.text + "' ";
    return result;
}

std::string rulesOf(const Report& report) {
    std::string result;
    for (const Finding& each : report.findings) result += each.rule + " " + each.path + "\n";
    return result;
}

// One simplex of every type, so that each type's layout is in the structure.
std::shared_ptr<Structure> structureOf(const TypeModel& model) {
    SimplexTree tree{model};
    for (const auto& [name, type] : model.types()) {
        if (!type.isAbstract) tree.add("/" + name, name);
    }
    return makeStructure("test", tree);
}

void expectEqualItems(const std::vector<DataItem>& ours, const std::vector<DataItem>& theirs) {
    ASSERT_EQ(ours.size(), theirs.size());
    for (std::size_t i = 0; i < ours.size(); ++i) {
        EXPECT_EQ(ours[i].name, theirs[i].name);
        EXPECT_EQ(ours[i].description, theirs[i].description) << ours[i].name;
        EXPECT_EQ(ours[i].initial, theirs[i].initial) << ours[i].name;
        EXPECT_EQ(ours[i].hasDefault, theirs[i].hasDefault) << ours[i].name;
        EXPECT_EQ(ours[i].safe, theirs[i].safe) << ours[i].name;
    }
}

void expectEqualTypes(const Type& ours, const Type& theirs) {
    EXPECT_EQ(canonicalText(ours), canonicalText(theirs));
    EXPECT_EQ(ours.description, theirs.description);
    EXPECT_EQ(ours.parents, theirs.parents);
    EXPECT_EQ(ours.ancestors, theirs.ancestors);
    expectEqualItems(ours.data, theirs.data);
    ASSERT_EQ(ours.commands.size(), theirs.commands.size());
    for (std::size_t i = 0; i < ours.commands.size(); ++i) {
        EXPECT_EQ(ours.commands[i].description, theirs.commands[i].description);
        expectEqualItems(ours.commands[i].request, theirs.commands[i].request);
        expectEqualItems(ours.commands[i].response, theirs.commands[i].response);
    }
    ASSERT_EQ(ours.rules.size(), theirs.rules.size());
    for (std::size_t i = 0; i < ours.rules.size(); ++i) {
        EXPECT_EQ(ours.rules[i].description, theirs.rules[i].description);
    }
}

void expectEqualLayouts(const TypeModel& ours, const TypeModel& theirs) {
    const auto first = structureOf(ours), second = structureOf(theirs);
    ASSERT_EQ(first->layouts.size(), second->layouts.size());
    for (std::size_t n = 0; n < first->layouts.size(); ++n) {
        const TypeLayout &one = *first->layouts[n], &other = *second->layouts[n];
        ASSERT_EQ(one.type->name, other.type->name);
        ASSERT_EQ(one.items.size(), other.items.size()) << one.type->name;
        for (std::size_t i = 0; i < one.items.size(); ++i) {
            EXPECT_EQ(one.items[i].item->name, other.items[i].item->name) << one.type->name;
            EXPECT_EQ(one.items[i].offset, other.items[i].offset) << one.type->name;
            EXPECT_EQ(one.items[i].constant, other.items[i].constant) << one.type->name;
        }
    }
}

// The property of this file: what is described is told whole, in whatever order.
void expectToldWhole(const TypeModel& model) {
    std::vector<TypeDescription> described = describeAll(model);
    std::ranges::reverse(described);
    Report report;
    const TypeModel told = modelOf(described, report);
    EXPECT_EQ(report.text(), "");
    ASSERT_EQ(told.types().size(), model.types().size());
    for (const auto& [name, type] : model.types()) {
        expectEqualTypes(type, told.at(name));
        EXPECT_EQ(describe(told.at(name)), describe(type)) << name;
    }
    expectEqualLayouts(model, told);
}

void expectToldWhole(const XmlModel& model) {
    ASSERT_TRUE(isValid(model));
    expectToldWhole(model.files.types);
}

class ShippedTypes : public testing::TestWithParam<const char*> {};

TEST_P(ShippedTypes, AreToldWhole) {
    expectToldWhole(TypeModel::load(std::filesystem::path{CORTEX_SOURCE_DIR} / GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Files, ShippedTypes,
                         testing::Values("ontology/base-morphology.xml",
                                         "ontology/cortex-morphology.xml",
                                         "tests/data/command-rules.xml", "tests/data/cs-rules.xml",
                                         "tests/data/determinism-rules.xml",
                                         "tests/data/schema/valid/morphology.xml"));

TEST(TypeDescription, SpellsAttributesAsXmlDoes) {
    const XmlModel model = readTypes(
        "<type name='Activity' role='active'/>"
        "<type name='Axis' role='modification' version='1.2' writers='many' icon='a b'>"
        "<data name='mode' kind='int' labels='2:Jog 0:Idle' safe='hold' settable='Active Standby'/>"
        "<data name='speed' kind='float' unit='rad/s' min='-1' max='1.50' default='0.50' "
        "safe='0' format='%.2f' constant='false'/>"
        "<data name='names' kind='string' length='3' capacity='9' "
        "default='\"two words\" \"\" plain' safe='observed'/></type>"
        "<type name='Drive' extends='Activity'>"
        "<command name='go' available='always' long='true' timeout='2'>"
        "<request name='to' kind='float' description='Where to.'/></command></type>",
        "<rules type='Drive'><relationship name='axes' direction='output' target='Axis' max='2' "
        "create='Axis' description='What it moves.'/></rules>");
    ASSERT_TRUE(isValid(model));

    const TypeDescription axis = describe(model.type("Axis"));
    const TypeDescription drive = describe(model.type("Drive"));

    EXPECT_EQ(text(axis.attributes),
              "icon='a b' role='modification' version='1.2' writers='many' ");
    EXPECT_EQ(text(named(axis.data, "mode").attributes),
              "kind='int' labels='0:Idle 2:Jog' safe='hold' settable='Standby Active' ");
    EXPECT_EQ(text(named(axis.data, "speed").attributes),
              "default='0.5' format='%.2f' kind='float' max='1.5' min='-1' safe='0' "
              "unit='rad/s' ");
    EXPECT_EQ(text(named(axis.data, "names").attributes),
              "capacity='9' default='\"two words\" \"\" plain' kind='string' length='3' "
              "safe='observed' ");
    EXPECT_EQ(text(drive.commands[0].attributes), "available='always' long='true' timeout='2' ");
    EXPECT_EQ(drive.commands[0].request[0].description, "Where to.");
    EXPECT_EQ(text(drive.rules[0].attributes),
              "create='Axis' direction='output' max='2' target='Axis' ");
    EXPECT_EQ(drive.rules[0].description, "What it moves.");
    EXPECT_EQ(drive.hash, typeHash(model.type("Drive")));
    expectToldWhole(model);
}

TEST(TypeDescription, TellsWhatAChildTakesBackToTheDefault) {
    expectToldWhole(readTypes(
        "<type name='Base' role='active' onLeaseLost='hold' transitionTimeout='3' measures='true' "
        "version='2' since='1' icon='base'>"
        "<data name='x' kind='float' default='5'/>"
        "<command name='c' timeout='3' onBusy='replace' onInputLost='continue' "
        "onSenderLost='cancel' "
        "available='always'>"
        "<request name='p' kind='int' default='3'/></command></type>"
        "<type name='Child' extends='Base' onLeaseLost='continue' transitionTimeout='10' "
        "measures='false'><data name='x' default='0'/>"
        "<command name='c' timeout='0' onBusy='reject' onInputLost='fail' onSenderLost='continue' "
        "available='Active'><request name='p' default='0'/></command></type>"
        "<type name='Grandchild' extends='Child'/>",
        "<rules type='Base'><relationship name='r' direction='input' target='Base' "
        "onLoss='fault' maxAge='0.01'/></rules>"
        "<rules type='Child'><relationship name='r' onLoss='propagate' maxAge='0.05'/></rules>"));
}

TEST(TypeDescription, TellsLabelsThatANarrowedRangeExcludes) {
    expectToldWhole(
        readTypes("<type name='A'><data name='m' kind='int' labels='0:Off 1:On 2:Auto'/></type>"
                  "<type name='B' extends='A'><data name='m' min='0' max='1'/></type>"
                  "<type name='C' extends='B'/>"
                  "<type name='D' extends='A'><data name='m' max='1' labels='-1:Back'/></type>"));
}

TEST(TypeDescription, TellsWhatParentsMakeTogether) {
    expectToldWhole(readTypes(
        "<type name='A' writers='many'><data name='x' kind='float' min='0' resolution='0.2' "
        "description='Of A.'/><data name='m' kind='int' labels='0:Off'/></type>"
        "<type name='B' writers='one' version='1'><data name='x' kind='float' max='9' "
        "resolution='0.1' default='2' description='Of B.'/>"
        "<data name='m' kind='int' labels='1:On'/></type>"
        "<type name='Open'/>"
        "<type name='AB' extends='A B Open' version='1'/>"
        "<type name='AO' extends='Open A'/>"
        "<type name='ABO' extends='AB AO' role='observation'><data name='x' default='3'/></type>"));
}

TEST(TypeDescription, TellsTextsWithBlanksQuotesAndLineEnds) {
    std::vector<TypeDeclaration> declarations(1);
    TypeDeclaration& type = declarations.front();
    type.name = "Notes";
    type.description = " blanks around \n and 'quotes' \"of\" <both> kinds & more ";
    type.icon = "a \"b\"\\";
    DataItem item;
    item.kind = Kind::String;
    for (const char* each : {"", " ", "\"", "\\", "a b", "line\nend", "tab\t", "hold", "0:x"}) {
        item.name = "scalar" + std::to_string(type.data.size());
        item.initial = std::vector<std::string>{each};
        item.hasDefault = true;
        type.data.push_back(item);
    }
    item.name = "list";
    item.length = 5;
    item.initial = std::vector<std::string>{"", "a b\n", "\"q\"", "\\", "hold"};
    item.safe = {Safe::Kind::Given, item.initial};
    type.data.push_back(item);
    Report report;
    const TypeModel model = TypeModel::build(declarations, report);
    ASSERT_EQ(report.text(), "");

    expectToldWhole(model);
}

// Two types that are fine, and one that says of itself what the test makes it say.
struct Told : testing::Test {
    const XmlModel xml = readTypes(
        "<type name='Base' role='active'><data name='x' kind='float' min='0' max='1'/>"
        "<command name='go'><request name='to' kind='int'/></command></type>"
        "<type name='Child' extends='Base'/>"
        "<type name='Other'><data name='y' kind='int' labels='0:A 1:B'/></type>",
        "<rules type='Base'><relationship name='r' direction='input' target='Other'/></rules>");
    std::vector<TypeDescription> described = describeAll(xml.files.types);
    Report report;

    TypeDescription& base() { return in(described, "Base"); }
    TypeDescription& other() { return in(described, "Other"); }
    // Names of the types that were taken.
    std::string taken() {
        const TypeModel model = modelOf(described, report);
        std::string names;
        for (const auto& [name, type] : model.types()) names += name + " ";
        for (const Finding& each : report.findings) EXPECT_FALSE(each.remedy.empty()) << each.rule;
        return names;
    }
};

TEST_F(Told, AttributesOfALaterVersionAreKeptAndHandedOn) {
    Type later = xml.files.types.at("Base");
    later.unknown = {{"condition.zoneFree", "/door.closed and\n\"clear\""}, {"zeta", ""}};
    later.data[0].unknown = {{"audience", "maintenance"}};
    later.commands[0].unknown = {{"needs", "2"}};
    later.commands[0].request[0].unknown = {{"safe2", "1"}};
    later.rules[0].unknown = {{"onSlow", "axes"}};
    base() = describe(later);

    const TypeModel model = modelOf(described, report);
    EXPECT_EQ(report.text(), "");
    EXPECT_EQ(describe(model.at("Base")), describe(later));
    EXPECT_EQ(model.at("Child").data[0].unknown, UnknownAttributes{});
    const std::string text = canonicalText(model.at("Base"));
    EXPECT_NE(text.find("type Base\n condition.zoneFree \"/door.closed and\\n\\\"clear\\\"\"\n"
                        " role active\n zeta \"\"\n"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("data x\n audience \"maintenance\"\n max 1"), std::string::npos) << text;

    for (const Disagreement& each : compare(xml.files.types.at("Base"), model.at("Base"))) {
        EXPECT_FALSE(each.contradiction) << each.text();
    }
    EXPECT_EQ(compare(xml.files.types.at("Base"), model.at("Base")).size(), 6U);
}

TEST_F(Told, WithAnotherHashATypeAndItsChildrenAreLeftOut) {
    ++base().hash[3];
    EXPECT_EQ(taken(), "Other ");
    EXPECT_EQ(rulesOf(report), "type-hash Base\nunknown-parent Child\n");
}

TEST_F(Told, WithAHashOfItsOwnAnotherTypeIsTaken) {
    const XmlModel newer = readTypes("<type name='Other'><data name='y' kind='bool'/></type>");
    other() = describe(newer.type("Other"));
    EXPECT_EQ(taken(), "Base Child Other ");
    EXPECT_EQ(rulesOf(report), "");
}

TEST_F(Told, LessThanItInheritsATypeIsLeftOut) {
    const XmlModel bare = readTypes(
        "<type name='Base' role='active'><command name='go'><request name='to' kind='int'/>"
        "</command></type><type name='Child' extends='Base'/>");
    in(described, "Child") = describe(bare.type("Child"));
    EXPECT_EQ(taken(), "Base Other ");
    EXPECT_EQ(rulesOf(report), "type-hash Child\n");
}

TEST_F(Told, MoreThanItMayATypeIsLeftOut) {
    for (DescribedAttribute& each : in(described, "Child").data.front().attributes) {
        if (each.name == "max") each.text = "2";
    }
    EXPECT_EQ(taken(), "Base Other ");
    EXPECT_EQ(rulesOf(report), "range-widened Child\n");
}

TEST_F(Told, WithAnUnknownParentATypeIsLeftOut) {
    in(described, "Child").parents = {"Bass"};
    EXPECT_EQ(taken(), "Base Other ");
    EXPECT_EQ(rulesOf(report), "unknown-parent Child\n");
}

TEST_F(Told, InACircleTypesAreLeftOut) {
    base().parents = {"Child"};
    EXPECT_EQ(taken(), "Other ");
}

TEST_F(Told, TwiceATypeIsLeftOut) {
    described.push_back(other());
    EXPECT_EQ(taken(), "Base Child ");
    EXPECT_EQ(rulesOf(report), "duplicate-type Other\n");
}

TEST_F(Told, WithAnUnknownTargetATypeIsLeftOut) {
    std::erase_if(described, [](const auto& each) { return each.name == "Other"; });
    EXPECT_EQ(taken(), "");
    EXPECT_EQ(rulesOf(report), "unknown-target Base\nunknown-parent Child\n");
}

TEST_F(Told, WhatNoFileCanSayIsRefused) {
    using Change = void (*)(TypeDescription&);
    const Change changes[] = {
        [](TypeDescription& type) { type.attributes.push_back({"name", "Other"}); },
        [](TypeDescription& type) { type.data[0].attributes.push_back({"kind", "int"}); },
        [](TypeDescription& type) { type.data[0].attributes.push_back({"a b", "1"}); },
        [](TypeDescription& type) { type.data[0].description = "\xff"; },
        [](TypeDescription& type) { type.description = std::string{"a\0b", 3}; },
        [](TypeDescription& type) { type.name = "\xc0\x80"; },
        [](TypeDescription& type) { type.parents = {"Base Child"}; },
        [](TypeDescription& type) { type.parents.assign(65, "Base"); },
        [](TypeDescription& type) {
            type.commands = {{"c", "", {}, {}, {}}};
            type.commands[0].request.resize(513);
        },
        [](TypeDescription& type) {
            for (int i = 0; i < 65; ++i) {
                type.data[0].attributes.push_back({"a" + std::to_string(i), ""});
            }
        }};
    const TypeDescription sound = other();
    for (const Change change : changes) {
        TypeDescription& changed = described.back();
        ASSERT_EQ(changed.data.size(), 1U);
        change(changed);
        report = {};
        modelOf(described, report);
        EXPECT_EQ(std::ranges::count(report.findings, "type-description", &Finding::rule), 1)
            << report.text();
        changed = sound;
    }
}

TEST_F(Told, OfOneTypeNotEveryFindingIsReported) {
    for (int i = 0; i < 1000; ++i) other().data.push_back({"d" + std::to_string(i), {}, ""});
    EXPECT_EQ(taken(), "Base Child ");
    EXPECT_EQ(std::ranges::count(report.findings, "kind-missing", &Finding::rule), 20);
}

TEST_F(Told, TooMuchAltogetherIsRefused) {
    TypeDescription large = other();
    large.description = std::string(9U << 20U, 'x');
    for (int i = 0; i < 8; ++i) {
        large.name = "Large" + std::to_string(i);
        described.push_back(large);
    }
    taken();
    EXPECT_EQ(std::ranges::count(report.findings, "model-size", &Finding::rule), 1);
}

TEST(TypeDescription, ClosureHasAncestorsTargetsAndWhatIsCreated) {
    const XmlModel model = readTypes(
        "<type name='Root'/><type name='Base' extends='Root'/><type name='Top' extends='Base'/>"
        "<type name='Target'/><type name='Made' extends='Target'/><type name='Far'/>"
        "<type name='Unused' extends='Top'/>",
        "<rules type='Base'><relationship name='r' direction='output' target='Target' "
        "create='Made'/></rules>"
        "<rules type='Made'><relationship name='f' direction='input' target='Far'/></rules>");
    ASSERT_TRUE(isValid(model));
    const auto names = [&](const std::vector<std::string>& wanted) {
        std::string result;
        for (const Type* each : closureOf(model.files.types, wanted)) result += each->name + " ";
        return result;
    };

    EXPECT_EQ(names({"Top"}), "Base Far Made Root Target Top ");
    EXPECT_EQ(names({"Far", "Root", "Far", "none"}), "Far Root ");
    EXPECT_EQ(names({}), "");
}

TEST(TypeDescription, ClosureOfAnyShippedTypeIsToldWithoutTheOthers) {
    const TypeModel model = TypeModel::load(std::filesystem::path{CORTEX_SOURCE_DIR} /
                                            "ontology/cortex-morphology.xml");
    for (const auto& [name, type] : model.types()) {
        std::vector<TypeDescription> described;
        for (const Type* each : closureOf(model, std::span{&name, 1})) {
            described.push_back(describe(*each));
        }
        Report report;
        const TypeModel told = modelOf(described, report);
        EXPECT_EQ(report.text(), "") << name;
        EXPECT_EQ(typeHash(told.at(name)), typeHash(type)) << name;
    }
}

}  // namespace
}  // namespace cortex
