// SPDX-License-Identifier: Apache-2.0
// The graph of a system: families, layers, crossings and what goes back.
#include "model/layered_layout.hpp"
#include "model/system_graph.hpp"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using gui::layered;
using gui::LayoutEdge;

using Edges = std::vector<LayoutEdge>;

TEST(GraphLayout, PutsEachNodeBehindAllThatItWaitsFor) {
    const Edges edges{{0, 1}, {1, 2}, {0, 2}, {3, 2}};
    const auto layout = layered(4, edges);
    for (const LayoutEdge& edge : edges) {
        EXPECT_LT(layout.nodes[edge.from].layer, layout.nodes[edge.to].layer);
    }
    EXPECT_EQ(layout.nodes[3].layer, 1) << "a source stands beside who reads it";
    EXPECT_EQ(layout.bends[2].size(), 1U) << "the long edge passes one layer";
}

TEST(GraphLayout, FindsAnOrderWithoutCrossingsWhereThereIsOne) {
    // Three pairs, joined the wrong way round.
    const auto layout = layered(6, Edges{{0, 5}, {1, 4}, {2, 3}, {0, 4}, {2, 4}});
    EXPECT_EQ(layout.crossings, 0);
}

TEST(GraphLayout, CountsTheCrossingsThatCannotBeAvoided) {
    // All of three with all of three: at least nine in two layers.
    Edges edges;
    for (std::uint32_t from = 0; from < 3; ++from) {
        for (std::uint32_t to = 3; to < 6; ++to) edges.push_back({from, to});
    }
    EXPECT_EQ(layered(6, edges).crossings, 9);
}

TEST(GraphLayout, SendsBackWhatClosesALoopAndWhatIsDelayed) {
    const auto loop = layered(3, Edges{{0, 1}, {1, 2}, {2, 0}});
    EXPECT_EQ(loop.back, (std::vector{false, false, true}));
    EXPECT_EQ(loop.layers, 3);

    const auto delayed = layered(2, Edges{{0, 1}, {1, 0, true}});
    EXPECT_EQ(delayed.back, (std::vector{false, true}));
}

TEST(GraphLayout, NoTwoNodesOfOneLayerOverlap) {
    Edges edges;
    for (std::uint32_t i = 1; i < 40; ++i) edges.push_back({(i - 1) / 3, i});
    edges.push_back({38, 38});
    const auto layout = layered(45, edges);  // five of them alone
    for (std::size_t a = 0; a < 45; ++a) {
        for (std::size_t b = a + 1; b < 45; ++b) {
            if (layout.nodes[a].layer != layout.nodes[b].layer) continue;
            EXPECT_GE(std::abs(layout.nodes[a].row - layout.nodes[b].row), 0.999)
                << a << " and " << b;
        }
    }
}

TEST(GraphLayout, ALongChainIsLaidOut) {
    Edges edges;
    for (std::uint32_t i = 1; i < 20'000; ++i) edges.push_back({i - 1, i});
    EXPECT_EQ(layered(20'000, edges).layers, 20'000);
}

// Agents made by hand: simplexes by path and type, and their relationships.
class Related : public testing::Test {
protected:
    Related() {
        axis.name = "Axis";
        controller.name = "Controller";
        demand.name = "demand";
        demand.direction = Direction::Output;
        measured.name = "measured";
        measured.direction = Direction::Input;
        axisLayout.type = &axis;
        controllerLayout.type = &controller;
    }

    std::uint32_t add(Structure& structure, std::string path, const TypeLayout& layout) {
        structure.simplexes.emplace_back();
        structure.simplexes.back().path = std::move(path);
        structure.simplexes.back().layout = &layout;
        return static_cast<std::uint32_t>(structure.simplexes.size() - 1);
    }
    void take(std::shared_ptr<Structure> structure) {
        frame.agents.emplace_back();
        frame.agents.back().structure = std::move(structure);
    }
    // A controller that demands of three axes and measures them one cycle later.
    std::shared_ptr<Structure> threeAxes() {
        auto structure = std::make_shared<Structure>();
        const auto owner = add(*structure, "/control", controllerLayout);
        for (const char* path : {"/axes/1", "/axes/2", "/axes/3"}) {
            const auto target = add(*structure, path, axisLayout);
            structure->edges.push_back({owner, target, &demand, false});
            structure->edges.push_back({owner, target, &measured, true});
        }
        add(*structure, "/alone", axisLayout);
        return structure;
    }
    static std::vector<std::string> keys(const gui::SystemGraph& graph) {
        std::vector<std::string> keys;
        for (const auto& node : graph.nodes) keys.push_back(node.key);
        return keys;
    }

    Type axis, controller;
    Rule demand, measured;
    TypeLayout axisLayout, controllerLayout;
    gui::Frame frame;
};

TEST_F(Related, SiblingsThatAreRelatedAlikeAreOneFamily) {
    take(threeAxes());
    const auto graph = makeSystemGraph(frame, {});
    EXPECT_EQ(keys(graph), (std::vector<std::string>{"/axes/*", "/control"}));
    EXPECT_EQ(graph.nodes[0].paths.size(), 3U);
    EXPECT_EQ(graph.find("/axes/2"), 0U);
    EXPECT_EQ(graph.unrelated, 1) << "/alone is related to nothing";

    EXPECT_EQ(keys(makeSystemGraph(frame, {"/axes/*"})),
              (std::vector<std::string>{"/axes/1", "/axes/2", "/axes/3", "/control"}));
}

TEST_F(Related, ASiblingThatIsRelatedOtherwiseStandsAlone) {
    const auto structure = threeAxes();
    const auto other = add(*structure, "/other", controllerLayout);
    structure->edges.push_back({other, 2, &demand, false});
    take(structure);
    EXPECT_EQ(keys(makeSystemGraph(frame, {})),
              (std::vector<std::string>{"/axes/*", "/axes/2", "/control", "/other"}));
}

TEST_F(Related, EdgesPointWhereValuesFlow) {
    take(threeAxes());
    const auto graph = makeSystemGraph(frame, {});
    ASSERT_EQ(graph.edges.size(), 2U);
    const auto& observed = graph.edges[0];
    EXPECT_EQ(graph.nodes[observed.from].key, "/axes/*");
    EXPECT_EQ(observed.rules, std::vector<std::string>{"measured"});
    EXPECT_TRUE(observed.delayed);
    const auto& demanded = graph.edges[1];
    EXPECT_EQ(graph.nodes[demanded.to].key, "/axes/*");
    EXPECT_FALSE(demanded.delayed);
}

TEST_F(Related, ARelationshipJoinsTheAgentsOfBothEnds) {
    auto one = std::make_shared<Structure>();
    const auto owner = add(*one, "/control", controllerLayout);
    const auto link = add(*one, "/far", axisLayout);
    one->simplexes[link].remote = true;
    one->edges.push_back({owner, link, &demand, false});
    auto two = std::make_shared<Structure>();
    const auto far = add(*two, "/far", axisLayout);
    const auto monitor = add(*two, "/monitor", controllerLayout);
    two->edges.push_back({monitor, far, &measured, false});
    take(std::move(one));
    take(std::move(two));
    const auto graph = makeSystemGraph(frame, {});
    EXPECT_EQ(keys(graph), (std::vector<std::string>{"/control", "/far", "/monitor"}));
    EXPECT_EQ(graph.edges.size(), 2U);
}

}  // namespace
}  // namespace cortex::test
