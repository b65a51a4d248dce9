// SPDX-License-Identifier: Apache-2.0
#include "model/query.hpp"

#include "gui/measured_agent.hpp"
#include "support/small_structure.hpp"

#include <numbers>

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

TEST(Query, NamesTheNearestStateQualityAndRoleForAnUnknownOne) {
    EXPECT_TRUE(Query{"state:Fualt"}.trouble().contains("Fault"));
    EXPECT_TRUE(Query{"-quality:lots"}.trouble().contains("lost"));
    EXPECT_TRUE(Query{"role:activ"}.trouble().contains("active"));
    for (const char* each : {"state:fault", "quality:Lost", "role:Active", "state:", "agent:lots"})
        EXPECT_EQ(Query{each}.trouble(), QString{}) << each;
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
    ASSERT_TRUE(more->number);
    EXPECT_EQ(more->number->near(), -1.5e-3);
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

class QueriedUnits : public testing::Test {
protected:
    QueriedUnits() {
        agent.put("/joint", "angle", std::numbers::pi / 6);
        agent.put("/joint", "tilt", 90.0);
        agent.put("/joint", "way", 0.25);
        agent.put("/joint", "speed", std::numbers::pi);
        agent.put("/joint", "steps", std::int64_t{1500});
    }
    bool holds(const char* text) {
        const auto frame = frameOf({agent.now()});
        const Query query{text};
        EXPECT_EQ(query.troubleIn(*frame), "") << text;
        return query.matches(*frame, {0, agent.at("/joint")});
    }
    std::string trouble(const char* text) {
        return Query{text}.troubleIn(*frameOf({agent.now()})).toStdString();
    }

    MadeAgent agent{"robot", [](SimplexTree& tree) { tree.add("/joint", "Joint"); },
                    "unit-types.xml"};
};

TEST_F(QueriedUnits, AreConvertedWhereTheyAreWritten) {
    for (const char* each :
         {"way>200mm", "way=250mm", "way>0.2m", "way>0.2", "angle>29deg", "angle<31°",
          "speed>=180deg/s", "speed<=180°/s", "tilt<1.6rad", "steps>1.4m", "steps>1400mm"})
        EXPECT_TRUE(holds(each)) << each;
    for (const char* each : {"way>300mm", "way>200", "angle>31deg", "tilt>1.6rad", "steps>1.6m"})
        EXPECT_FALSE(holds(each)) << each;
}

TEST_F(QueriedUnits, AreNamedWhereTheItemHasAnother) {
    EXPECT_EQ(trouble("way>1kg"), "\"kg\" is no unit of way, which is in m.");
    EXPECT_EQ(trouble("-speed>1rad"), "\"rad\" is no unit of speed, which is in rad/s.");
    EXPECT_EQ(trouble("torque<1mm or way>1"), "\"mm\" is no unit of torque, which is in N·m.");
    EXPECT_EQ(trouble("nowhere>1kg"), "") << "that is another matter";
}

TEST(Query, AValueThatNeverCameFulfilsNoCondition) {
    EXPECT_EQ(hits("position<1"), 0);
    EXPECT_EQ(hits("position>=1"), 0);
    EXPECT_EQ(hits("outside"), 0);
}

}  // namespace
}  // namespace cortex::test
