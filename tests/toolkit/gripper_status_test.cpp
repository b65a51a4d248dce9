// SPDX-License-Identifier: Apache-2.0
// A gripper with a status limits its force itself.
#include "gripper_rig.hpp"

#include <variant>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

struct GripperWithStatus : testing::Test {
    GripperWithStatus() { rig.begin(); }
    FingerRig rig;
};

TEST_F(GripperWithStatus, GoesWhereItIsToldAndPassesTheForceOn) {
    ASSERT_TRUE(rig.ask("moveTo", {{"width", 0.03}, {"force", 25.0}}).done());
    EXPECT_NEAR(rig.width(), 0.03, ofAnOpening);
    EXPECT_EQ(rig.object(), GripperRig::AtDemand);
    EXPECT_EQ(rig.mayUse(), 25);
    ASSERT_TRUE(rig.ask("close").done());
    EXPECT_EQ(rig.mayUse(), 0) << "the least that the gripper can";
    EXPECT_NEAR(rig.width(), 0, ofAnOpening);
    EXPECT_EQ(rig.limitCount(), 0);
}

TEST_F(GripperWithStatus, KeepsItsDemandBeyondTheWorkPieceAndOpensFromThere) {
    rig.put(workPiece);
    const CallResult result = rig.ask("grip", "force", 60.0);
    ASSERT_TRUE(result.done()) << result.text();
    EXPECT_NEAR(std::get<std::vector<double>>(result.response.at("width")).front(), workPiece,
                ofAnOpening);
    rig.go(1000);
    EXPECT_EQ(rig.object(), GripperRig::StoppedClosing);
    EXPECT_EQ(rig.demand(), 0);
    EXPECT_EQ(rig.mayUse(), 60);
    ASSERT_TRUE(rig.ask("open").done());
    EXPECT_EQ(rig.mayUse(), 60) << "what is held is never pressed harder by an opening";
    EXPECT_NEAR(rig.width(), 0.085, ofAnOpening);
    EXPECT_EQ(rig.object(), GripperRig::AtDemand);
    EXPECT_EQ(rig.limitCount(), 0);
    EXPECT_EQ(rig.told(), "");
}

TEST_F(GripperWithStatus, IsMovingWhileItsDemandMovesWhateverItSays) {
    rig.cluster().send("/it", "close");
    rig.go(300);
    EXPECT_EQ(rig.object(), GripperRig::Moving);
    rig.put(0.07);  // the fingers stand, the demand goes on
    rig.go(150);
    ASSERT_EQ(rig.get<std::int64_t>("/status", "object"), GripperRig::StoppedClosing);
    EXPECT_EQ(rig.object(), GripperRig::Moving);
}

TEST_F(GripperWithStatus, FailsToGripNothing) {
    const CallResult result = rig.ask("grip");
    EXPECT_EQ(result.outcome, Outcome::Failed);
    EXPECT_EQ(result.why, "the jaws have closed, and nothing is between them");
}

TEST_F(GripperWithStatus, SaysNothingOfAWorkPieceThatGivesWayALittle) {
    rig.put(workPiece);
    ASSERT_TRUE(rig.ask("grip").done());
    rig.put(workPiece - 0.001);
    rig.go(20);
    EXPECT_EQ(rig.object(), GripperRig::Moving);
    rig.go(2000);
    EXPECT_EQ(rig.object(), GripperRig::StoppedClosing);
    EXPECT_EQ(rig.told(), "");
}

TEST_F(GripperWithStatus, TellsThatAWorkPieceIsLost) {
    rig.put(workPiece);
    ASSERT_TRUE(rig.ask("grip").done());
    rig.put(0);
    rig.go(2000);
    EXPECT_EQ(rig.told(), "the work piece was lost at an opening of 0.038 m\n");
    EXPECT_EQ(rig.object(), GripperRig::AtDemand);
}

TEST_F(GripperWithStatus, SaysThatNobodyKnowsWhileItIsLostAndAfterwardsWhatItHolds) {
    rig.put(workPiece);
    ASSERT_TRUE(rig.ask("grip").done());
    ASSERT_TRUE(rig.call("/it", "shutdown").done());
    rig.step(100);
    EXPECT_EQ(rig.object(), GripperRig::StoppedClosing) << "it holds it by itself";
    ASSERT_TRUE(rig.call("/it", "startup").done());
    rig.step(500);
    EXPECT_EQ(rig.told(), "");

    rig.tree().at("/status").slot().quality = Quality::Lost;
    rig.step();
    EXPECT_EQ(rig.object(), GripperRig::Lost);
    EXPECT_TRUE(rig.told().ends_with(
        "whether the work piece is still held is not known: the gripper is lost\n"))
        << rig.told();
    rig.step(500);
    EXPECT_EQ(rig.object(), GripperRig::StoppedClosing);
}

TEST_F(GripperWithStatus, SaysOnceThatNobodyKnowsWhileItsDriveIsDisabled) {
    constexpr std::int64_t enabled = 1, disabled = 6;
    rig.put(workPiece);
    ASSERT_TRUE(rig.ask("grip").done());
    rig.say(disabled);
    rig.step(500);
    EXPECT_EQ(rig.object(), GripperRig::Lost);
    EXPECT_EQ(rig.told(),
              "whether the work piece is still held is not known: /axis does not follow: its drive "
              "says Disabled\n");
    rig.say(enabled);
    rig.step(500);
    EXPECT_EQ(rig.object(), rig.get<std::int64_t>("/status", "object")) << "as it says itself";
}

}  // namespace
}  // namespace cortex::toolkit::test
