// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/structure.hpp"

#include "cortex/core/agent.hpp"
#include "cortex/core/make_structure.hpp"

#include "core/model_folder.hpp"

#include <gtest/gtest.h>

namespace cortex {
namespace {

using test::smallTypes;

// A controller of one axis and the device behind it, and an axis of another agent.
SimplexTree plant() {
    SimplexTree tree{smallTypes()};
    auto& observed = tree.add("/observed", "Axis");
    auto& demanded = tree.add("/demanded", "SharedAxis");
    auto& controller = tree.add("/controller", "Controller");
    auto& device = tree.add("/device", "Device");
    controller.runEvery(5, 2);
    tree.relate(controller, "demands", demanded);
    tree.relate(controller, "axes", observed, true);
    tree.relateRemote(controller, "axes", "/far/axis");
    tree.relate(device, "demand", demanded);
    tree.relate(device, "observation", observed);
    return tree;
}

const SimplexInfo& infoOf(const Structure& structure, const std::string& path) {
    return structure.simplexes.at(structure.find(path));
}

TEST(BlockSizes, Add) {
    BlockSizes sizes{1, 2, 3, 4};

    sizes += BlockSizes{10, 20, 30, 40};

    EXPECT_EQ(sizes.ints, 11U);
    EXPECT_EQ(sizes.floats, 22U);
    EXPECT_EQ(sizes.bools, 33U);
    EXPECT_EQ(sizes.strings, 44U);
}

TEST(TypeLayout, PlacesItemsByKindAndConstantsApart) {
    SimplexTree tree{smallTypes()};
    tree.add("/axis", "Axis");
    const auto structure = makeStructure("test", tree);

    const TypeLayout& layout = *infoOf(*structure, "/axis").layout;

    EXPECT_EQ(layout.cyclic.ints, 1U);                      // mode
    EXPECT_EQ(layout.cyclic.floats, 2U);                    // position, velocity
    EXPECT_EQ(layout.cyclic.strings, StringCell::size(8));  // note
    EXPECT_EQ(layout.constant.floats, 3U);                  // direction
    ASSERT_NE(layout.find("velocity"), nullptr);
    EXPECT_EQ(layout.find("position")->offset, 0U);
    EXPECT_EQ(layout.find("velocity")->offset, 1U);
    EXPECT_EQ(layout.find("direction")->offset, 0U);
    EXPECT_EQ(layout.find("velocities"), nullptr);
    EXPECT_EQ(layout.find(""), nullptr);
}

TEST(TypeLayout, ConstantsOfAnotherAgentsSimplexLieWithTheRest) {
    const SimplexTree tree = plant();
    const auto structure = makeStructure("test", tree);

    const TypeLayout& far = *infoOf(*structure, "/far/axis").layout;

    EXPECT_TRUE(far.remote);
    EXPECT_EQ(far.constant.floats, 0U);
    EXPECT_FALSE(far.find("direction")->constant);
    EXPECT_TRUE(infoOf(*structure, "/observed").layout->find("direction")->constant);
}

TEST(RecordLayout, PlacesParametersAtMultiplesOfEight) {
    std::vector<DataItem> parameters(4);
    parameters[0].name = "on";
    parameters[0].kind = Kind::Bool;
    parameters[0].length = 3;
    parameters[1].name = "text";
    parameters[1].kind = Kind::String;
    parameters[1].capacity = 5;
    parameters[2].name = "points";
    parameters[2].length = 2;
    parameters[3].name = "last";
    parameters[3].kind = Kind::Int;

    const RecordLayout layout = recordLayout(parameters);

    EXPECT_EQ(layout.find("on")->offset, 0U);
    EXPECT_EQ(layout.find("text")->offset, 8U);
    EXPECT_EQ(layout.find("points")->offset, 8U + StringCell::size(5));
    EXPECT_EQ(layout.find("last")->offset, 24U + StringCell::size(5));
    EXPECT_EQ(layout.size, 32U + StringCell::size(5));
    EXPECT_EQ(layout.find("none"), nullptr);
    EXPECT_EQ(recordLayout({}).size, 0U);
}

TEST(Structure, SortsByPathWithRemoteSimplexesLast) {
    const SimplexTree tree = plant();

    const auto structure = makeStructure("test", tree);

    ASSERT_EQ(structure->simplexes.size(), 5U);
    EXPECT_EQ(structure->agent, "test");
    EXPECT_EQ(structure->simplexes[0].path, "/controller");
    EXPECT_EQ(structure->simplexes[3].path, "/observed");
    EXPECT_EQ(structure->simplexes[4].path, "/far/axis");
    EXPECT_TRUE(structure->simplexes[4].remote);
    EXPECT_EQ(structure->simplexes[4].layout->type->name, "Axis");  // the rule's target
    EXPECT_EQ(structure->find("/far/axis"), 4U);
    EXPECT_EQ(structure->find("/nowhere"), noSimplex);
}

TEST(Structure, OrdersEdgesByOwnerAndRule) {
    const SimplexTree tree = plant();

    const auto structure = makeStructure("test", tree);

    const SimplexInfo& controller = infoOf(*structure, "/controller");
    ASSERT_EQ(controller.edgeCount, 3U);
    const Edge* edges = &structure->edges[controller.firstEdge];
    EXPECT_EQ(edges[0].rule->name, "axes");
    EXPECT_EQ(edges[0].target, structure->find("/observed"));
    EXPECT_TRUE(edges[0].delayed);
    EXPECT_EQ(edges[1].target, structure->find("/far/axis"));
    EXPECT_EQ(edges[2].rule->name, "demands");
    EXPECT_FALSE(edges[2].delayed);
    const SimplexInfo& device = infoOf(*structure, "/device");
    EXPECT_TRUE(structure->edges[device.firstEdge + 1].delayed);  // its rule says so
}

TEST(Structure, DecidesWhatAnInstanceIs) {
    const SimplexTree tree = plant();

    const auto structure = makeStructure("test", tree);

    EXPECT_EQ(infoOf(*structure, "/controller").role, Role::Active);
    EXPECT_EQ(infoOf(*structure, "/demanded").role, Role::Modification);
    EXPECT_EQ(infoOf(*structure, "/observed").role, Role::Observation);
    EXPECT_EQ(infoOf(*structure, "/far/axis").role, Role::Observation);
    EXPECT_TRUE(infoOf(*structure, "/observed").delayedOutput);
    EXPECT_FALSE(infoOf(*structure, "/demanded").delayedOutput);
}

TEST(Structure, KnowsTheWritersOfASimplex) {
    SimplexTree tree = plant();
    tree.relate(tree.add("/another", "Controller"), "demands", tree.at("/demanded"));

    const auto structure = makeStructure("test", tree);

    EXPECT_EQ(infoOf(*structure, "/demanded").writers,
              (std::vector{structure->find("/another"), structure->find("/controller")}));
    EXPECT_EQ(infoOf(*structure, "/observed").writers, std::vector{structure->find("/device")});
    EXPECT_TRUE(infoOf(*structure, "/controller").writers.empty());
}

TEST(Structure, TakesRatesAndLaysSlicesOneAfterTheOther) {
    const SimplexTree tree = plant();

    const auto structure = makeStructure("test", tree);

    EXPECT_EQ(infoOf(*structure, "/controller").every, 5U);
    EXPECT_EQ(infoOf(*structure, "/controller").phase, 2);
    EXPECT_EQ(infoOf(*structure, "/device").phase, -1);
    BlockSizes sum, constantSum;
    for (const auto& info : structure->simplexes) {
        EXPECT_EQ(info.base.floats, sum.floats) << info.path;
        EXPECT_EQ(info.base.strings, sum.strings) << info.path;
        EXPECT_EQ(info.constantBase.floats, constantSum.floats) << info.path;
        sum += info.layout->cyclic;
        constantSum += info.layout->constant;
    }
    EXPECT_EQ(structure->cyclic.floats, sum.floats);
    EXPECT_EQ(structure->cyclic.bools, sum.bools);
    EXPECT_EQ(structure->constant.floats, constantSum.floats);
    EXPECT_EQ(structure->constant.floats, 6U);
}

TEST(Structure, SharesOneLayoutAmongSimplexesOfAType) {
    SimplexTree tree{smallTypes()};
    tree.add("/a", "Axis");
    tree.add("/b", "Axis");

    const auto structure = makeStructure("test", tree);

    EXPECT_EQ(structure->layouts.size(), 1U);
    EXPECT_EQ(structure->simplexes[0].layout, structure->simplexes[1].layout);
}

TEST(Structure, GivesARemoteSimplexTheMostDerivedOfItsTypes) {
    SimplexTree tree{smallTypes()};
    auto& before = tree.add("/a", "Switch");
    auto& controller = tree.add("/b", "Controller");
    auto& after = tree.add("/c", "Switch");
    for (auto* each : {&before, &after}) tree.relateRemote(*each, "watched", "/far");
    tree.relateRemote(controller, "axes", "/far");

    const auto structure = makeStructure("test", tree);

    EXPECT_EQ(structure->simplexes.size(), 4U);
    EXPECT_EQ(infoOf(*structure, "/far").layout->type->name, "Axis");  // not its parent Concept
}

}  // namespace
}  // namespace cortex
