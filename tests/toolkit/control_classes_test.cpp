// SPDX-License-Identifier: Apache-2.0
#include "mechanics/lbr_chain.hpp"
#include "rig.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

using mechanics::Pose;
using mechanics::SerialChain;
using mechanics::test::lbrChain;
using mechanics::test::lbrPosture;

Rig::Pairs sevenOf(const std::string& rule, const std::string& folder) {
    Rig::Pairs pairs;
    for (int i = 1; i <= 7; ++i) pairs.emplace_back(rule, folder + "/" + std::to_string(i));
    return pairs;
}

void place(Rig& rig, const SerialChain::JointVector& joints) {
    for (int i = 0; i < 7; ++i) {
        rig.tree().at("/lbr/axes/" + std::to_string(i + 1)).data<double>("position") = joints[i];
    }
}

TEST(ForwardKinematics, RefusesAxesOfAnotherAgentAsTheirGeometryComesLater) {
    Rig rig;
    SystemDescription::SimplexEntry forward;
    forward.path = "/forward";
    forward.type = "ForwardKinematics";
    forward.relates.push_back({"axes", "/arm/1", false, true, {}});
    rig.add(forward);
    try {
        rig.start();
        FAIL();
    } catch (const Error& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("/forward: /arm/1 belongs to another agent, and its geometry comes"),
                  std::string::npos)
            << text;
    }
}

// The geometry in the ontology is that of the data sheet.
TEST(ForwardKinematics, FindsTheTipOfTheLbr) {
    Rig rig;
    rig.add("/lbr", "KukaLbr");
    rig.add("/forward", "ForwardKinematics", sevenOf("axes", "/lbr/axes"));
    rig.start();
    rig.startUp();
    const SerialChain chain = lbrChain();
    for (int seed = 0; seed < 20; ++seed) {
        SerialChain::JointVector joints(7);
        for (int i = 0; i < 7; ++i) joints[i] = std::sin(seed * 7 + i * 3 + 1.0);
        place(rig, joints);
        rig.step();
        const Pose expected = chain.forward(joints);

        const auto position = rig.array("/forward/tip", "position");
        const auto rotation = rig.array("/forward/tip", "rotation");

        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_NEAR(position[i], expected.position[static_cast<int>(i)], 1e-12);
        }
        const Pose found{{}, {rotation[3], rotation[0], rotation[1], rotation[2]}};
        EXPECT_NEAR(found.rotation.angularDistance(expected.rotation), 0, 1e-7);
    }
}

class LbrInverse : public testing::Test {
protected:
    void SetUp() override {
        rig_.add("/lbr", "KukaLbr");
        rig_.add("/target", "CartesianConcept");
        for (int i = 1; i <= 7; ++i) rig_.add("/targets/" + std::to_string(i), "RotaryAxisConcept");
        Rig::Pairs relates = sevenOf("axes", "/lbr/axes");
        relates.emplace_back("target", "/target");
        for (const auto& pair : sevenOf("targets", "/targets")) relates.push_back(pair);
        rig_.add("/inverse", "InverseKinematics", relates);
        rig_.start();
        place(rig_, lbrPosture());
        aim(chain_.forward(lbrPosture()));
        rig_.startUp();
    }
    void aim(const Pose& pose) {
        auto position = rig_.tree().at("/target").array<double>("position");
        auto rotation = rig_.tree().at("/target").array<double>("rotation");
        for (std::size_t i = 0; i < 3; ++i) {
            position[i] = pose.position[static_cast<int>(i)];
            rotation[i] = pose.rotation.vec()[static_cast<int>(i)];
        }
        rotation[3] = pose.rotation.w();
    }
    SerialChain::JointVector solution() {
        SerialChain::JointVector joints(7);
        for (int i = 0; i < 7; ++i) {
            joints[i] = rig_.get<double>("/targets/" + std::to_string(i + 1), "position");
        }
        return joints;
    }
    Rig rig_;
    SerialChain chain_ = lbrChain();
};

TEST_F(LbrInverse, StaysWhereTheArmIsWhenThatIsTheTarget) {
    rig_.step(10);

    EXPECT_NEAR((solution() - lbrPosture()).norm(), 0, 1e-6);
    EXPECT_TRUE(rig_.get<bool>("/inverse", "reached"));
}

TEST_F(LbrInverse, BringsTheTipToThePoseNoFasterThanTheAxesMay) {
    Pose target = chain_.forward(lbrPosture());
    target.position += Eigen::Vector3d{0.02, 0.03, -0.02};
    aim(target);
    SerialChain::JointVector before = solution();
    double fastest = 0;
    for (int i = 0; i < 150; ++i) {
        rig_.step();
        const SerialChain::JointVector now = solution();
        const SerialChain::JointVector moved = (now - before).cwiseAbs();
        fastest = std::max(fastest, moved.cwiseQuotient(chain_.maxSpeed()).maxCoeff() * 1e3);
        before = now;
    }

    EXPECT_LT(difference(chain_.forward(solution()), target).norm(), 1e-6);
    EXPECT_LE(fastest, 1 + 1e-6);
    EXPECT_GT(fastest, 0.9);
}

TEST_F(LbrInverse, TakesTheWayOfATargetInAStandstillForNoJump) {
    const double speed = 0.5;  // m/s, so 0.05 m in 100 ticks, where 0.02 m are a jump
    const auto seeds = rig_.get<std::int64_t>("/inverse", "seedCount");
    rig_.tree().at("/target").array<double>("linearVelocity")[2] = -speed;
    Pose target = chain_.forward(lbrPosture());
    const auto goOn = [&](int ticks) {
        target.position.z() -= speed * ticks * 1e-3;
        aim(target);
    };
    for (const int late : {0, 0, 100, 0}) {
        rig_.standStill(late);
        goOn(1 + late);
    }
    rig_.step();

    EXPECT_EQ(rig_.get<std::int64_t>("/inverse", "seedCount"), seeds);
}

TEST_F(LbrInverse, BeginsAnewWhenTheArmIsElsewhere) {
    const auto seeds = rig_.get<std::int64_t>("/inverse", "seedCount");
    SerialChain::JointVector elsewhere = lbrPosture();
    elsewhere[0] += 0.5;
    place(rig_, elsewhere);
    aim(chain_.forward(elsewhere));

    rig_.step(2);

    EXPECT_EQ(rig_.get<std::int64_t>("/inverse", "seedCount"), seeds + 1);
    EXPECT_NEAR((solution() - elsewhere).norm(), 0, 1e-6);
}

// Of an arm whose elbow stands elsewhere than the last solution says.
TEST_F(LbrInverse, BeginsAnewFromTheAxesWhereItsTargetJumps) {
    Pose moved = chain_.forward(lbrPosture());
    moved.position.z() += 0.015;
    aim(moved);
    rig_.step(100);
    SerialChain::JointVector stands = solution();
    stands[2] += 0.02;
    place(rig_, stands);
    Pose back = chain_.forward(stands);
    aim(back);
    const auto seeds = rig_.get<std::int64_t>("/inverse", "seedCount");
    rig_.step(10);
    ASSERT_EQ(rig_.get<std::int64_t>("/inverse", "seedCount"), seeds) << "a small step";
    EXPECT_GT((solution() - stands).cwiseAbs().maxCoeff(), 0.004);

    back.position.z() -= 0.03;
    aim(back);
    rig_.step();
    EXPECT_EQ(rig_.get<std::int64_t>("/inverse", "seedCount"), seeds + 1);
    EXPECT_LT((solution() - stands).cwiseAbs().maxCoeff(), 0.003) << "a cycle from the axes";
}

class Selector : public testing::Test {
protected:
    void SetUp() override {
        rig_.add("/hand", "CartesianObservation");
        rig_.add("/button", "DigitalIoConcept");
        for (const char* name : {"/axis", "/target", "/demand"})
            rig_.add(name, "RotaryAxisConcept");
        rig_.add("/follow", "FollowAxisController",
                 {{"axes", "/axis"}, {"targets", "/target"}, {"demands", "/demand"}});
        rig_.add("/hold", "HoldAxisController", {{"axes", "/axis"}, {"demands", "/demand"}});
        rig_.add("/selector", "ProcessorSelector",
                 {{"whileMoving", "/follow"},
                  {"otherwise", "/hold"},
                  {"hand", "/hand"},
                  {"enable", "/button"}});
        rig_.start();
        rig_.startUp();
        rig_.step(10);
    }
    void hand(bool pressed, double speed) {
        rig_.tree().at("/button").data<bool>("value") = pressed;
        rig_.tree().at("/hand").array<double>("linearVelocity")[1] = speed;
    }
    void expectActive(const char* active, const char* other) {
        EXPECT_EQ(rig_.state(active), State::Active);
        expectStandby(other);
    }
    void expectStandby(const char* path) { EXPECT_EQ(rig_.state(path), State::Standby); }
    Rig rig_;
};

TEST_F(Selector, HoldsUnlessTheHandMovesWithTheButtonPressed) {
    expectActive("/hold", "/follow");
    hand(true, 0);
    rig_.step(300);
    expectActive("/hold", "/follow");
    hand(false, 0.2);
    rig_.step(10);
    expectActive("/hold", "/follow");
    hand(true, 0.2);
    rig_.step(4);  // starting up, both Active, shutting down, at rest
    expectActive("/follow", "/hold");
}

TEST_F(Selector, HoldsAfterTheHandStoodStillForAWhile) {
    hand(true, 0.2);
    rig_.step(10);
    hand(true, 0);
    rig_.step(190);
    expectActive("/follow", "/hold");
    rig_.step(20);
    expectActive("/hold", "/follow");
    EXPECT_EQ(rig_.get<std::int64_t>("/selector", "switchCount"), 2);
}

TEST_F(Selector, HoldsAtOnceWhenTheButtonIsReleasedOrTheHandIsLost) {
    hand(true, 0.2);
    rig_.step(10);
    hand(false, 0.2);
    rig_.step(4);
    expectActive("/hold", "/follow");
    hand(true, 0.2);
    rig_.step(10);
    rig_.tree().at("/hand").slot().quality = Quality::Lost;
    rig_.step(4);
    expectActive("/hold", "/follow");
}

TEST_F(Selector, SaysWhyAndNeedsANewPressAfterALoss) {
    enum Reason : std::int64_t { HandMoves = 1, HandStill, NotEnabled, InputLost };
    const auto expectReason = [this](Reason reason) {
        rig_.step(3);
        EXPECT_EQ(rig_.get<std::int64_t>("/selector", "reason"), reason);
    };
    expectReason(NotEnabled);
    hand(true, 0.2);
    expectReason(HandMoves);
    rig_.tree().at("/hand").slot().quality = Quality::Lost;
    expectReason(InputLost);
    rig_.tree().at("/hand").slot().quality = Quality::Good;
    expectReason(NotEnabled);
    hand(false, 0.2);
    expectReason(NotEnabled);
    hand(true, 0.2);
    expectReason(HandMoves);
    hand(true, 0);
    rig_.step(210);
    expectReason(HandStill);
}

TEST_F(Selector, ShutsDownAfterItsChoicesHave) {
    hand(true, 0.2);
    rig_.step(10);

    EXPECT_TRUE(rig_.call("/selector", "shutdown").done());

    EXPECT_EQ(rig_.state("/follow"), State::Standby);
    EXPECT_EQ(rig_.state("/hold"), State::Standby);
    EXPECT_EQ(rig_.get<std::int64_t>("/selector", "selected"), 0);
}

// With a wish that changes faster than an exchange is over.
TEST_F(Selector, NeverHasNoneActiveAndBothForNoMoreThanACycle) {
    bool bothBefore = false;
    for (int i = 0; i < 400; ++i) {
        hand(i % 3 != 0, i % 5 != 0 ? 0.2 : 0);
        rig_.step();
        const bool follow = rig_.state("/follow") == State::Active;
        const bool hold = rig_.state("/hold") == State::Active;
        EXPECT_TRUE(follow || hold) << i;
        EXPECT_FALSE(follow && hold && bothBefore) << i;
        bothBefore = follow && hold;
    }
    EXPECT_EQ(rig_.get<std::int64_t>("/rig", "conflictCount"), 0);
}

TEST_F(Selector, DoesNotLetTheHandLeadOnWhereWhatHoldsDoesNotStart) {
    hand(true, 0.2);
    rig_.step(10);
    expectActive("/follow", "/hold");
    rig_.tree().at("/axis").slot().quality = Quality::Bad;
    hand(false, 0.2);
    rig_.step(4);
    expectStandby("/hold");
    expectStandby("/follow");

    rig_.tree().at("/axis").slot().quality = Quality::Good;
    rig_.step(510);
    expectActive("/hold", "/follow");
}

}  // namespace
}  // namespace cortex::toolkit::test
