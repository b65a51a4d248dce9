// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agent.hpp"
#include "cortex/core/error.hpp"
#include "cortex/core/make_structure.hpp"
#include "cortex/core/type_description.hpp"
#include "cortex/core/validation.hpp"

#include "core/model_folder.hpp"
#include "core/xml_model.hpp"

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

// The structure that another agent makes of what the owner says of its types and simplexes.
namespace cortex {
namespace {

struct SaidRelation {
    std::string rule, target;
    bool delayed = false, remote = false;
};
struct SaidSimplex {
    std::string path, type;
    std::uint32_t every = 1;
    std::int32_t phase = -1;
    std::vector<SaidRelation> relations;
};
struct Said {
    std::vector<TypeDescription> types;
    std::vector<SaidSimplex> simplexes;
};

Said say(const Structure& structure) {
    Said said;
    std::vector<std::string> used;
    for (const SimplexInfo& info : structure.simplexes) {
        if (info.remote) continue;
        SaidSimplex simplex{info.path, info.layout->type->name, info.every, info.phase, {}};
        used.push_back(simplex.type);
        for (std::uint32_t i = 0; i < info.edgeCount; ++i) {
            const Edge& edge = structure.edges[info.firstEdge + i];
            const SimplexInfo& target = structure.simplexes[edge.target];
            simplex.relations.push_back(
                {edge.rule->name, target.path, edge.delayed, target.remote});
        }
        said.simplexes.push_back(std::move(simplex));
    }
    for (const Type* each : closureOf(*structure.types, used)) {
        said.types.push_back(describe(*each));
    }
    return said;
}

std::shared_ptr<const Structure> heard(const std::string& agent, const Said& said) {
    Report report;
    SimplexTree tree{modelOf(said.types, report)};
    EXPECT_EQ(report.text(), "");
    for (const SaidSimplex& each : said.simplexes) {
        tree.add(each.path, each.type).runEvery(static_cast<int>(each.every), each.phase);
    }
    for (const SaidSimplex& each : said.simplexes) {
        Simplex& owner = tree.at(each.path);
        for (const SaidRelation& relation : each.relations) {
            if (relation.remote) {
                tree.relateRemote(owner, relation.rule, relation.target, {}, relation.delayed);
            } else {
                tree.relate(owner, relation.rule, tree.at(relation.target), relation.delayed);
            }
        }
    }
    return makeStructure(agent, tree);
}

void expectEqual(const BlockSizes& ours, const BlockSizes& theirs) {
    EXPECT_EQ(ours.ints, theirs.ints);
    EXPECT_EQ(ours.floats, theirs.floats);
    EXPECT_EQ(ours.bools, theirs.bools);
    EXPECT_EQ(ours.strings, theirs.strings);
}

void expectEqual(const TypeLayout& ours, const TypeLayout& theirs) {
    EXPECT_EQ(ours.type->name, theirs.type->name);
    EXPECT_EQ(typeHash(*ours.type), typeHash(*theirs.type));
    EXPECT_EQ(ours.remote, theirs.remote);
    expectEqual(ours.cyclic, theirs.cyclic);
    expectEqual(ours.constant, theirs.constant);
    ASSERT_EQ(ours.items.size(), theirs.items.size());
    for (std::size_t i = 0; i < ours.items.size(); ++i) {
        EXPECT_EQ(ours.items[i].item->name, theirs.items[i].item->name);
        EXPECT_EQ(ours.items[i].offset, theirs.items[i].offset);
        EXPECT_EQ(ours.items[i].constant, theirs.items[i].constant);
    }
}

void expectEqual(const Structure& ours, const Structure& theirs) {
    ASSERT_EQ(ours.simplexes.size(), theirs.simplexes.size());
    for (std::size_t i = 0; i < ours.simplexes.size(); ++i) {
        const SimplexInfo &one = ours.simplexes[i], &other = theirs.simplexes[i];
        SCOPED_TRACE(one.path);
        EXPECT_EQ(one.path, other.path);
        EXPECT_EQ(one.role, other.role);
        EXPECT_EQ(one.remote, other.remote);
        EXPECT_EQ(one.every, other.every);
        EXPECT_EQ(one.phase, other.phase);
        EXPECT_EQ(one.writers, other.writers);
        EXPECT_EQ(one.delayedOutput, other.delayedOutput);
        EXPECT_EQ(one.firstEdge, other.firstEdge);
        EXPECT_EQ(one.edgeCount, other.edgeCount);
        expectEqual(one.base, other.base);
        expectEqual(one.constantBase, other.constantBase);
        expectEqual(*one.layout, *other.layout);
    }
    ASSERT_EQ(ours.edges.size(), theirs.edges.size());
    for (std::size_t i = 0; i < ours.edges.size(); ++i) {
        EXPECT_EQ(ours.edges[i].owner, theirs.edges[i].owner);
        EXPECT_EQ(ours.edges[i].target, theirs.edges[i].target);
        EXPECT_EQ(ours.edges[i].rule->name, theirs.edges[i].rule->name);
        EXPECT_EQ(ours.edges[i].delayed, theirs.edges[i].delayed);
    }
    expectEqual(ours.cyclic, theirs.cyclic);
    expectEqual(ours.constant, theirs.constant);
}

TEST(ForeignStructure, IsThatOfTheOwnerOfACaseStudy) {
    const std::filesystem::path file{CORTEX_SOURCE_DIR "/examples/lbr_teleop/lbr_teleop.xml"};
    SimplexTree tree = SimplexTree::load(std::span{&file, 1});
    const std::size_t written = tree.simplexes().size();
    tree.createRelated();
    ASSERT_GT(tree.simplexes().size(), written);  // some are created by rules
    const auto owned = makeStructure("teleop", tree);

    expectEqual(*owned, *heard("teleop", say(*owned)));
}

TEST(ForeignStructure, HasRatesWritersDelaysAndSimplexesOfOtherAgents) {
    SimplexTree tree{test::smallTypes()};
    auto& observed = tree.add("/observed", "Axis");
    auto& demanded = tree.add("/demanded", "SharedAxis");
    auto& controller = tree.add("/controller", "Controller");
    auto& device = tree.add("/device", "Device");
    controller.runEvery(5, 2);
    tree.relate(controller, "demands", demanded);
    tree.relateRemote(controller, "axes", "/far/second", {}, true);
    tree.relate(controller, "axes", observed, true);
    tree.relateRemote(controller, "axes", "/far/first");
    tree.relate(device, "demand", demanded);
    tree.relate(device, "observation", observed);
    const auto owned = makeStructure("plant", tree);
    ASSERT_EQ(owned->simplexes.size(), 6U);
    ASSERT_TRUE(owned->edges[owned->simplexes[owned->find("/controller")].firstEdge].delayed);

    expectEqual(*owned, *heard("plant", say(*owned)));
}

// Offsets have 32 bit: more data than that must not make small tables.
TEST(ForeignStructure, OfTooMuchDataIsRefused) {
    const test::XmlModel model = test::readTypes(
        "<type name='Large'><data name='a' kind='string' length='65536' capacity='4096'/></type>");
    SimplexTree tree{model.files.types};
    for (int i = 1; i <= 17; ++i) tree.add("/large" + std::to_string(i), "Large");

    EXPECT_THROW(makeStructure("test", tree), ModelError);
    const Report report = validate(tree);
    ASSERT_EQ(report.findings.size(), 1U) << report.text();
    EXPECT_EQ(report.findings[0].rule, "data-size");
}

}  // namespace
}  // namespace cortex
