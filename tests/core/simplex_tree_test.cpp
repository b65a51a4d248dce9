// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/simplex_tree.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/registry.hpp"

#include "core/model_folder.hpp"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

namespace cortex {
namespace {

using test::checkSmall;
using test::smallTypes;

std::vector<std::string> targets(const Simplex& owner, const std::string& rule) {
    std::vector<std::string> paths;
    for (const auto& relation : owner.relations()) {
        if (relation.rule == rule) paths.push_back(relation.target);
    }
    return paths;
}

std::string errorOf(const auto& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

class Pump final : public Simplex {
public:
    Pump(Identity identity, int litres) : Simplex{std::move(identity)}, size{litres} {}
    int size;
};

TEST(SimplexTree, TakesPathsOfUpToEightLevels) {
    EXPECT_EQ(SimplexTree::pathError("/a/b-1/C_2"), "");
    EXPECT_EQ(SimplexTree::pathError("/1/2/3/4/5/6/7/8"), "");
    EXPECT_EQ(SimplexTree::pathError("/" + std::string(127, 'a')), "");
}

TEST(SimplexTree, SaysWhatIsWrongWithAPath) {
    EXPECT_EQ(SimplexTree::pathError(""), "a path begins with '/'");
    EXPECT_EQ(SimplexTree::pathError("arm"), "a path begins with '/'");
    EXPECT_EQ(SimplexTree::pathError("/"), "the path ends with '/'");
    EXPECT_EQ(SimplexTree::pathError("/arm/"), "the path ends with '/'");
    EXPECT_EQ(SimplexTree::pathError("/arm//lbr"), "a level of the path is empty");
    EXPECT_NE(SimplexTree::pathError("/arm/l br").find("' ' is not allowed"), std::string::npos);
    EXPECT_NE(SimplexTree::pathError("/1/2/3/4/5/6/7/8/9").find("this has 9"), std::string::npos);
    EXPECT_NE(SimplexTree::pathError("/" + std::string(128, 'a')).find("this has 129"),
              std::string::npos);
}

TEST(SimplexTree, FindsWhatWasAdded) {
    SimplexTree tree{smallTypes()};

    auto& axis = tree.add("/axis", "Axis");

    EXPECT_EQ(tree.find("/axis"), &axis);
    EXPECT_EQ(&tree.at("/axis"), &axis);
    EXPECT_EQ(axis.type().name, "Axis");
    EXPECT_EQ(tree.find("/other"), nullptr);
}

TEST(SimplexTree, MakesObjectsOfTheUsersClass) {
    SimplexTree tree{smallTypes()};

    const Pump& pump = tree.add<Pump>("/pump", "Controller", 7);

    EXPECT_EQ(pump.size, 7);
    EXPECT_EQ(tree.find("/pump"), &pump);
}

TEST(SimplexTree, RefusesWhatCannotStand) {
    SimplexTree tree{smallTypes()};
    tree.add("/axis", "Axis");

    EXPECT_NE(errorOf([&] { tree.add("/axis", "Axis"); }).find("already"), std::string::npos);
    EXPECT_NE(errorOf([&] { tree.add("axis", "Axis"); }).find("begins with"), std::string::npos);
    EXPECT_NE(errorOf([&] { tree.add("/x", "Axsi"); }).find("Axis"), std::string::npos);
    EXPECT_NE(errorOf([&] { tree.add("/x", "Tool"); }).find("abstract"), std::string::npos);
    EXPECT_NE(errorOf([&] { tree.at("/axsi"); }).find("/axis"), std::string::npos);
    EXPECT_EQ(tree.simplexes().size(), 1U);
}

TEST(SimplexTree, RelatesInOrder) {
    SimplexTree tree{smallTypes()};
    auto& controller = tree.add("/controller", "Controller");
    tree.relate(controller, "axes", tree.add("/b", "Axis"));
    tree.relate(controller, "axes", tree.add("/a", "Axis"), true);
    tree.relateRemote(controller, "axes", "/far/axis");

    EXPECT_EQ(targets(controller, "axes"), (std::vector<std::string>{"/b", "/a", "/far/axis"}));
    EXPECT_TRUE(controller.relations()[1].delayed);
    EXPECT_TRUE(controller.relations()[2].remote);
}

TEST(SimplexTree, CreatesWhatRulesAskForUpToTheirMinimum) {
    SimplexTree tree{smallTypes()};
    auto& three = tree.add("/three", "Three");

    tree.createRelated();

    EXPECT_EQ(targets(three, "axes"),
              (std::vector<std::string>{"/three/axes/1", "/three/axes/2", "/three/axes/3"}));
    EXPECT_EQ(tree.at("/three/axes/1").type().name, "Axis1");
    EXPECT_EQ(tree.at("/three/axes/2").type().name, "Axis2");
    EXPECT_EQ(tree.at("/three/axes/3").type().name, "Axis2");  // the last type repeats
    EXPECT_EQ(targets(three, "base"), std::vector<std::string>{"/three/base"});  // max 1
}

TEST(SimplexTree, CreatesNothingTwice) {
    SimplexTree tree{smallTypes()};
    auto& three = tree.add("/three", "Three");
    tree.createRelated();
    const auto once = targets(three, "axes");

    tree.createRelated();

    EXPECT_EQ(targets(three, "axes"), once);
    EXPECT_EQ(tree.simplexes().size(), 5U);
}

TEST(SimplexTree, CreatesTheRestInTheirPlaces) {
    SimplexTree tree{smallTypes()};
    auto& three = tree.add("/three", "Three");
    tree.relate(three, "axes", tree.add("/mine", "Axis"));

    tree.createRelated();

    EXPECT_EQ(targets(three, "axes"),
              (std::vector<std::string>{"/mine", "/three/axes/2", "/three/axes/3"}));
    EXPECT_EQ(tree.at("/three/axes/2").type().name, "Axis2");
    EXPECT_EQ(tree.find("/three/axes/1"), nullptr);
}

TEST(SimplexTree, TakesWhatStandsAtACreatedPath) {
    SimplexTree tree{smallTypes()};
    auto& three = tree.add("/three", "Three");
    auto& second = tree.add("/three/axes/2", "Axis2");
    second.set("position", 0.5);

    tree.createRelated();

    EXPECT_EQ(targets(three, "axes"),
              (std::vector<std::string>{"/three/axes/1", "/three/axes/2", "/three/axes/3"}));
    EXPECT_EQ(tree.find("/three/axes/2"), &second);
}

TEST(SimplexTree, KeepsTheOwnPlaceOfWhatIsRelatedByHand) {
    SimplexTree tree{smallTypes()};
    auto& three = tree.add("/three", "Three");
    tree.relate(three, "axes", tree.add("/three/axes/3", "Axis2"));

    tree.createRelated();

    EXPECT_EQ(targets(three, "axes"),
              (std::vector<std::string>{"/three/axes/1", "/three/axes/2", "/three/axes/3"}));
}

TEST(SimplexTree, EndsTheCreationOfWhatCreatesItself) {
    SimplexTree tree{smallTypes()};
    tree.add("/nest", "Nest");

    tree.createRelated();

    EXPECT_EQ(tree.simplexes().size(), 8U);  // the levels of a path
}

TEST(SimplexTree, MakesCreatedSimplexesOfTheirClass) {
    SimplexTree tree{smallTypes()};
    tree.add("/three", "Three");
    ClassRegistry registry;
    registry.addFactory("Axis1", [](Simplex::Identity identity) {
        return std::make_unique<Pump>(std::move(identity), 3);
    });

    tree.createRelated(&registry);

    EXPECT_NE(dynamic_cast<const Pump*>(tree.find("/three/axes/1")), nullptr);
    EXPECT_EQ(dynamic_cast<const Pump*>(tree.find("/three/axes/2")), nullptr);
}

TEST(SimplexTree, IsBuiltFromASystemFile) {
    const auto checked = checkSmall(
        "<simplex path=\"/c\" type=\"Controller\" every=\"4\" phase=\"1\">\n"
        "<relate rule=\"axes\" to=\"/a\" delayed=\"true\"/>\n"
        "<relate rule=\"axes\" to=\"/far\" remote=\"true\"/>\n"
        "<set data=\"gain\" value=\"2.5\"/>\n"
        "</simplex>\n"
        "<simplex path=\"/a\" type=\"Axis\"/>\n");

    ASSERT_TRUE(checked.report.ok()) << checked.report.text();
    const Simplex& controller = checked.tree->at("/c");
    EXPECT_EQ(controller.every(), 4);
    EXPECT_EQ(controller.phase(), 1);
    EXPECT_EQ(controller.place().line, 3);
    ASSERT_EQ(controller.relations().size(), 2U);
    EXPECT_TRUE(controller.relations()[0].delayed);
    EXPECT_EQ(controller.relations()[0].place.line, 4);
    EXPECT_TRUE(controller.relations()[1].remote);
    ASSERT_EQ(controller.settings().size(), 1U);
    EXPECT_EQ(controller.settings()[0].value, Value{std::vector{2.5}});
}

TEST(SimplexTree, LoadsAFileOrThrowsItsReport) {
    const test::ModelFolder folder;
    folder.write("m.xml", "<ontology name=\"m\"><type name=\"Axis\"/></ontology>");
    const std::array good{folder.write("good.xml",
                                       "<system name=\"s\"><ontology file=\"m.xml\"/>"
                                       "<simplex path=\"/a\" type=\"Axis\"/></system>")};
    const std::array bad{folder.write("bad.xml",
                                      "<system name=\"s\"><ontology file=\"m.xml\"/>"
                                      "<simplex path=\"/a\" type=\"Axsi\"/></system>")};

    EXPECT_NE(SimplexTree::load(good).find("/a"), nullptr);
    try {
        SimplexTree::load(bad);
        FAIL() << "an unknown type was taken";
    } catch (const ModelError& error) {
        ASSERT_EQ(error.report().findings.size(), 1U);
        EXPECT_EQ(error.report().findings[0].rule, "unknown-type");
        EXPECT_EQ(error.report().findings[0].remedy, "write type=\"Axis\"");
    }
}

}  // namespace
}  // namespace cortex
