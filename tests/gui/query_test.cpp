// SPDX-License-Identifier: Apache-2.0
#include "model/query.hpp"

#include "gui/measured_agent.hpp"
#include "support/small_structure.hpp"

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace gui;

// The plant of small_structure.hpp, of the agent "robot"; nothing of it has come.
Frame plantFrame() {
    Frame frame;
    AgentFrame robot;
    robot.status.name = "robot";
    robot.structure = makePlant().structure;
    frame.agents.push_back(std::move(robot));
    return frame;
}

int hits(const QString& text) {
    const Frame frame = plantFrame();
    const Query query{text};
    int count = 0;
    const auto& simplexes = frame.agents.front().structure->simplexes;
    for (std::uint32_t i = 0; i < simplexes.size(); ++i) count += query.matches(frame, {0, i});
    return count;
}

int all() { return static_cast<int>(makePlant().structure->simplexes.size()); }

TEST(Query, MatchesEverythingWhenItIsEmpty) {
    EXPECT_TRUE(Query{}.empty());
    EXPECT_EQ(hits(""), all());
    EXPECT_EQ(hits("   "), all());
}

TEST(Query, FindsPartsOfPathAndTypeInAnyCase) {
    EXPECT_EQ(hits("AXIS"), hits("axis"));
    EXPECT_GT(hits("axis"), 0);
    EXPECT_EQ(hits("\"no such words\""), 0);
}

TEST(Query, JoinsByAndBindsOrWeakerAndNegates) {
    EXPECT_EQ(hits("agent:robot axis"), hits("axis"));
    EXPECT_EQ(hits("axis or agent:robot"), all());
    EXPECT_EQ(hits("axis"), all() - hits("-axis"));
    EXPECT_EQ(hits("agent:nobody"), 0);
}

TEST(Query, KnowsPathsAndQualities) {
    EXPECT_EQ(hits("in:/"), all());
    EXPECT_EQ(hits("quality:lost"), all()) << "nothing has come";
    EXPECT_EQ(hits("lost"), all());
    EXPECT_EQ(hits("fault"), 0);
}

TEST(Query, NamesTheNearestFieldForAnUnknownOne) {
    const Query query{"stat:Fault"};
    EXPECT_TRUE(query.trouble().contains("state")) << query.trouble().toStdString();
    EXPECT_TRUE(Query{"state:Fault"}.trouble().isEmpty());
}

TEST(Query, NamesTheNearestTypesForAnUnknownOneOnceAllAreKnown) {
    MadeAgent robot = clusterNamed("robot");
    const auto frame = frameOf({robot.now()});
    const Query query{"fault or -is:Clust"};
    frame->complete = false;
    EXPECT_EQ(query.troubleIn(*frame), QString{}) << "it may still come";
    frame->complete = true;
    const QString trouble = query.troubleIn(*frame);
    EXPECT_TRUE(trouble.startsWith("No agent has a type \"Clust\"")) << trouble.toStdString();
    EXPECT_TRUE(trouble.contains("Cluster")) << trouble.toStdString();
    EXPECT_EQ(Query{"type:cluster is:Active"}.troubleIn(*frame), QString{});
    EXPECT_TRUE(Query{"stat:Fault"}.troubleIn(*frame).contains("state"));
}

TEST(Query, ReadsConditionsOnValues) {
    QString trouble;
    const auto more = conditionFrom("position>=-1.5e-3 rad", trouble);
    ASSERT_TRUE(more);
    EXPECT_EQ(more->item, "position");
    EXPECT_EQ(more->is, Condition::Is::AtLeast);
    EXPECT_EQ(more->number, -1.5e-3);
    EXPECT_EQ(more->unit, "rad");
    EXPECT_EQ(conditionFrom("mode!=Position", trouble)->word, "Position");
    EXPECT_FALSE(conditionFrom("in:/arm", trouble));
    EXPECT_FALSE(conditionFrom("axis", trouble));
    EXPECT_TRUE(trouble.isEmpty()) << trouble.toStdString();
}

TEST(Query, SaysThatAConditionNeedsANumber) {
    EXPECT_TRUE(Query{"position>fast"}.trouble().contains("number"));
    EXPECT_TRUE(Query{"position="}.trouble().contains("number"));
    EXPECT_TRUE(Query{"position>1"}.trouble().isEmpty());
}

TEST(Query, AValueThatNeverCameFulfilsNoCondition) {
    EXPECT_EQ(hits("position<1"), 0);
    EXPECT_EQ(hits("position>=1"), 0);
    EXPECT_EQ(hits("outside"), 0);
}

}  // namespace
}  // namespace cortex::test
