// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/loopback.hpp"

#include "rig.hpp"

#include <gtest/gtest.h>

// What knows an axis only as AxisConcept works with every kind of axis, here and elsewhere.
namespace cortex::toolkit::test {
namespace {

const char* const items[] = {"position", "velocity", "acceleration", "effort"};

TEST(AxisConcept, HasWhatEveryAxisHasInTheUnitsOfItsKind) {
    const TypeModel types = TypeModel::load(CORTEX_SOURCE_DIR "/ontology/cortex-morphology.xml");
    const auto units = [&](const char* type) {
        std::string text;
        for (const char* item : items) text += types.at(type).findData(item)->unit + " ";
        return text;
    };

    EXPECT_EQ(units("AxisConcept"), "* * * * ");
    EXPECT_EQ(units("RotaryAxisConcept"), "rad rad/s rad/s2 N.m ");
    EXPECT_EQ(units("LinearAxisConcept"), "m m/s m/s2 N ");
}

// A follower whose target is an axis of another agent, known there by its own type.
class FollowerElsewhere : public testing::TestWithParam<const char*> {};

TEST_P(FollowerElsewhere, TakesItsTargetFromAnAxisOfAnyKind) {
    LoopbackHub hub;
    Rig far{"far"}, near{"near"};
    far.add("/wave", GetParam());
    near.add("/axis", GetParam());
    near.add("/demand", GetParam());
    SystemDescription::SimplexEntry follow;
    follow.path = "/follow";
    follow.type = "FollowAxisController";
    follow.relates = {{"axes", "/axis", false, false, {}},
                      {"demands", "/demand", false, false, {}},
                      {"targets", "/wave", false, true, {}}};
    near.add(follow);
    for (Rig* rig : {&far, &near}) {
        rig->cluster().adoptInterface(hub.makeInterface());
        rig->start();
    }
    double value = 0.01;
    for (const char* item : items) far.tree().at("/wave").data<double>(item) = value += 0.01;
    for (int i = 0; i < 5; ++i) {
        far.step();
        near.step();
    }
    near.cluster().send("/near", "startup", {{"prefix", std::string{"/"}}});
    for (int i = 0; i < 10; ++i) {
        far.step();
        near.step();
    }

    EXPECT_EQ(near.state("/follow"), State::Active);
    EXPECT_DOUBLE_EQ(near.get<double>("/demand", "position"), 0.02);
    EXPECT_DOUBLE_EQ(near.get<double>("/demand", "velocity"), 0.03);
    EXPECT_DOUBLE_EQ(near.get<double>("/demand", "acceleration"), 0.04);
}

INSTANTIATE_TEST_SUITE_P(OfEachKind, FollowerElsewhere,
                         testing::Values("RotaryAxisConcept", "LinearAxisConcept"),
                         [](const auto& each) { return std::string{each.param}; });

}  // namespace
}  // namespace cortex::toolkit::test
