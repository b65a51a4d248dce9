// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agent.hpp"

#include "rig.hpp"

#include <cmath>
#include <deque>
#include <memory>
#include <string>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

constexpr double nearby = 1e-12;

// A hand, a tip and a button that the test moves; the tip is at 0.5 m at first.
class ClutchRig : public Rig {
public:
    ClutchRig() {
        add("/hand", "CartesianObservation");
        add("/tip", "CartesianObservation");
        add("/button", "DigitalIoConcept");
        add("/axis", "RotaryAxisObservation");
        add("/clutch", "CartesianFollowController",
            {{"hand", "/hand"}, {"tip", "/tip"}, {"enable", "/button"}, {"axes", "/axis"}});
        cluster().addEventSink([told = told_](const Event& event, const Structure&) {
            if (event.severity == Severity::Warning) *told += std::string{event.text.view()} + "\n";
        });
        start();
        setPosition("/tip", 0.5);
        startUp();
    }
    void setPosition(const std::string& frame, double x) {
        tree().at(frame).array<double>("position")[0] = x;
    }
    void setTurn(const std::string& frame, double angle, double sign = 1) {
        const auto rotation = tree().at(frame).array<double>("rotation");
        rotation[2] = sign * std::sin(angle / 2);
        rotation[3] = sign * std::cos(angle / 2);
    }
    void press(bool pressed) {
        tree().at("/button").data<bool>("value") = pressed;
        step();
    }
    void moveHand(double x) {
        setPosition("/hand", x);
        step();
    }
    void turnHand(double angle, double sign = 1) {
        setTurn("/hand", angle, sign);
        step();
    }
    void moveTip(double x) {
        setPosition("/tip", x);
        step();
    }
    void setDrive(std::int64_t status) {
        tree().at("/axis").data<std::int64_t>("status") = status;
        step();
    }
    double target() { return array("/clutch/target", "position")[0]; }
    double targetSpeed() { return array("/clutch/target", "linearVelocity")[0]; }
    double targetTurn() {
        const auto rotation = array("/clutch/target", "rotation");
        return 2 * std::atan2(rotation[2], rotation[3]);
    }
    bool engaged() { return get<bool>("/clutch", "engaged"); }
    std::int64_t letGoCount() { return get<std::int64_t>("/clutch", "letGoCount"); }
    std::int64_t engageCount() { return get<std::int64_t>("/clutch", "engageCount"); }
    std::string told() {  // warnings
        cluster().agent().events().flush();
        return *told_;
    }

private:
    std::shared_ptr<std::string> told_ = std::make_shared<std::string>();
};

class Clutch : public testing::Test {
protected:
    void expectLetGo(std::int64_t times = 1) {
        EXPECT_FALSE(rig_.engaged());
        EXPECT_EQ(rig_.letGoCount(), times);
    }
    void expectEngaged() {
        EXPECT_TRUE(rig_.engaged());
        EXPECT_EQ(rig_.letGoCount(), 0);
    }

    ClutchRig rig_;
};

TEST_F(Clutch, TargetIsTheTipUntilThePress) {
    rig_.moveHand(0.3);

    EXPECT_DOUBLE_EQ(rig_.target(), 0.5);
    EXPECT_FALSE(rig_.engaged());
}

TEST_F(Clutch, TargetMovesAsTheHandSinceThePress) {
    rig_.moveHand(0.3);
    rig_.press(true);
    EXPECT_DOUBLE_EQ(rig_.target(), 0.5);

    rig_.moveHand(0.34);

    EXPECT_DOUBLE_EQ(rig_.target(), 0.54);
}

TEST_F(Clutch, TargetStaysAfterTheRelease) {
    rig_.press(true);
    rig_.moveHand(0.04);
    rig_.press(false);
    rig_.moveHand(0.9);

    EXPECT_DOUBLE_EQ(rig_.target(), 0.54);
}

TEST_F(Clutch, ThePoseTurnsAsTheHandTurns) {
    rig_.press(true);
    rig_.turnHand(0.15);

    const auto turned = rig_.array("/clutch/target", "rotation");
    EXPECT_NEAR(std::abs(turned[2]), std::sin(0.075), nearby);
    EXPECT_NEAR(std::abs(turned[3]), std::cos(0.075), nearby);
}

TEST_F(Clutch, AfterALossOnlyANewPressEngages) {
    rig_.press(true);
    rig_.moveHand(0.04);
    rig_.tree().at("/hand").slot().quality = Quality::Lost;
    rig_.step();
    EXPECT_FALSE(rig_.engaged());

    rig_.tree().at("/hand").slot().quality = Quality::Good;
    rig_.moveHand(0.9);
    EXPECT_DOUBLE_EQ(rig_.target(), 0.54);
    rig_.press(false);
    rig_.press(true);
    rig_.moveHand(0.92);

    EXPECT_DOUBLE_EQ(rig_.target(), 0.52);  // from the tip, which is at 0.5
    EXPECT_EQ(rig_.engageCount(), 2);
    EXPECT_EQ(rig_.letGoCount(), 0);
}

TEST_F(Clutch, GoesOnWithAValueThatHasOnlyGrownOldAndNotWithOneThatItsWriterCallsStale) {
    rig_.press(true);
    SlotState& hand = rig_.tree().at("/hand").slot();
    hand.quality = Quality::Stale;
    rig_.moveHand(0.02);
    EXPECT_TRUE(rig_.engaged());
    EXPECT_DOUBLE_EQ(rig_.target(), 0.52);

    hand.time += 1'000'000;
    rig_.moveHand(0.04);

    EXPECT_FALSE(rig_.engaged());
    EXPECT_DOUBLE_EQ(rig_.target(), 0.52);
}

// --- letting go ---------------------------------------------------------------------------------

TEST_F(Clutch, LetsGoWhereTheTipIsFartherThanAllowed) {
    rig_.press(true);
    rig_.moveHand(0.049);
    expectEngaged();

    rig_.moveHand(0.051);

    expectLetGo();
}

TEST_F(Clutch, LetsGoWhereTheTipIsTurnedFartherThanAllowed) {
    rig_.press(true);
    rig_.turnHand(-0.199);
    expectEngaged();

    rig_.turnHand(-0.201);

    expectLetGo();
    EXPECT_NEAR(rig_.targetTurn(), 0, nearby);
}

TEST_F(Clutch, LetsGoWhereTheTipIsMovedAwayFromAHandAtRest) {
    rig_.press(true);
    rig_.moveTip(0.44);

    expectLetGo();
    EXPECT_DOUBLE_EQ(rig_.target(), 0.44);
}

constexpr std::int64_t driveIsReady = 1, driveIsAtLimit = 3, driveIsBraked = 7;

TEST_F(Clutch, LetsGoAtOnceWhereADriveDoesNotFollow) {
    rig_.press(true);
    rig_.moveHand(0.01);
    rig_.setDrive(driveIsAtLimit);
    expectEngaged();

    rig_.setDrive(driveIsBraked);

    expectLetGo();
    EXPECT_DOUBLE_EQ(rig_.target(), 0.5);
    EXPECT_EQ(rig_.told(),
              "lets go of /hand: /axis does not follow: its drive says Braked; press anew\n");
    rig_.moveTip(0.498);
    EXPECT_DOUBLE_EQ(rig_.target(), 0.498) << "no way is left for when it follows again";
}

TEST_F(Clutch, TakesAPressOnlyOnceItsDrivesFollow) {
    rig_.setDrive(driveIsBraked);
    rig_.press(true);
    rig_.setDrive(driveIsReady);
    rig_.moveHand(0.04);
    EXPECT_FALSE(rig_.engaged());
    EXPECT_EQ(rig_.told(), "");
    rig_.press(false);
    rig_.press(true);
    EXPECT_TRUE(rig_.engaged());
}

TEST_F(Clutch, TargetIsThenWhereTheTipIsAndAtRest) {
    rig_.press(true);
    const auto velocity = rig_.tree().at("/hand").array<double>("linearVelocity");
    velocity[0] = 1;
    rig_.setTurn("/tip", 0.1);
    rig_.setPosition("/tip", 0.51);
    rig_.moveHand(0.04);
    expectEngaged();
    EXPECT_EQ(rig_.targetSpeed(), 1);

    rig_.setTurn("/tip", 0.12);
    rig_.setPosition("/tip", 0.52);
    rig_.moveHand(0.08);

    expectLetGo();
    EXPECT_DOUBLE_EQ(rig_.target(), 0.52);
    EXPECT_NEAR(rig_.targetTurn(), 0.12, nearby);
    EXPECT_EQ(rig_.targetSpeed(), 0);
}

TEST_F(Clutch, AHandThatJumpsDoesNotMoveTheTarget) {
    rig_.press(true);
    rig_.moveHand(0.3);

    expectLetGo();
    EXPECT_DOUBLE_EQ(rig_.target(), 0.5);

    rig_.moveHand(0);
    EXPECT_DOUBLE_EQ(rig_.target(), 0.5);
    expectLetGo();
}

TEST_F(Clutch, AfterLettingGoOnlyANewPressEngages) {
    rig_.press(true);
    rig_.moveHand(0.3);
    rig_.moveHand(0.301);
    rig_.step(100);
    expectLetGo();
    EXPECT_DOUBLE_EQ(rig_.target(), 0.5);

    rig_.press(false);
    rig_.press(true);
    rig_.moveHand(0.321);

    EXPECT_TRUE(rig_.engaged());
    EXPECT_NEAR(rig_.target(), 0.52, nearby);
    EXPECT_EQ(rig_.engageCount(), 2);
    EXPECT_EQ(rig_.letGoCount(), 1);
}

TEST_F(Clutch, LetsGoAnewAfterANewPress) {
    for (std::int64_t times = 1; times <= 3; ++times) {
        rig_.press(true);
        rig_.moveHand(0.1 * static_cast<double>(times));
        expectLetGo(times);
        rig_.press(false);
    }
}

TEST_F(Clutch, ThePressIsWhereTheComparisonBegins) {
    rig_.moveHand(7);
    rig_.turnHand(2);
    rig_.press(true);
    rig_.step(2);

    expectEngaged();
    EXPECT_DOUBLE_EQ(rig_.target(), 0.5);
}

// Either sign of a quaternion is the same rotation.
TEST_F(Clutch, DoesNotLetGoWhereARotationIsGivenWithTheOtherSign) {
    rig_.press(true);
    rig_.turnHand(0.1);
    rig_.turnHand(0.1, -1);
    rig_.setTurn("/tip", 0.05, -1);
    rig_.step();

    expectEngaged();
    EXPECT_NEAR(std::remainder(rig_.targetTurn() - 0.1, 2 * std::acos(-1.0)), 0, nearby);
}

TEST_F(Clutch, FollowsAHandOfAMeterASecondWithTheLagOfDrivesWithoutVelocity) {
    rig_.press(true);
    std::deque<double> way(24, 0.0);  // ms
    for (int i = 1; i <= 1500; ++i) {
        way.push_back(i * 1e-3);
        rig_.setPosition("/tip", 0.5 + way.front());
        rig_.setTurn("/tip", way.front());
        rig_.setTurn("/hand", way.back());
        rig_.moveHand(way.back());
        way.pop_front();
    }

    expectEngaged();
    EXPECT_NEAR(rig_.target(), 2.0, nearby);
}

TEST_F(Clutch, AllowsWhatItsItemsSay) {
    rig_.press(true);
    EXPECT_TRUE(
        rig_.call("/clutch", "set", {{"greatestDistance", 0.3}, {"greatestAngle", 0.6}}).done());
    rig_.setTurn("/hand", 0.59);
    rig_.moveHand(0.29);
    expectEngaged();

    EXPECT_TRUE(rig_.call("/clutch", "set", {{"greatestDistance", 0.28}}).done());

    expectLetGo();
}

TEST_F(Clutch, SaysOncePerLettingGoHowFarTheTipWas) {
    rig_.press(true);
    rig_.moveHand(0.0625);
    rig_.step(20);
    EXPECT_EQ(rig_.told(),
              "lets go of /hand: the tip is 0.0625 m from its target, allowed 0.05; press anew\n");
    rig_.press(false);
    rig_.press(true);
    rig_.turnHand(0.25);
    rig_.step(20);

    EXPECT_EQ(rig_.told(),
              "lets go of /hand: the tip is 0.0625 m from its target, allowed 0.05; press anew\n"
              "lets go of /hand: the tip is 0.25 rad from its target, allowed 0.2; press anew\n");
}

// --- without a press ----------------------------------------------------------------------------

// An arm whose brakes slip, or that is pushed: what starts its drives finds the target at the tip.
TEST_F(Clutch, ATipThatGoesFarTakesTheTargetAlongAndOneThatStaysNearDoesNot) {
    rig_.moveTip(0.46);
    EXPECT_DOUBLE_EQ(rig_.target(), 0.5);

    rig_.moveTip(0.44);
    EXPECT_DOUBLE_EQ(rig_.target(), 0.44);
    EXPECT_EQ(rig_.letGoCount(), 0);

    rig_.setTurn("/tip", 0.3);
    rig_.step();
    EXPECT_NEAR(rig_.targetTurn(), 0.3, nearby);
    EXPECT_EQ(rig_.told(), "");
}

TEST_F(Clutch, ATipThatIsNotGoodLeavesTheTargetWhereItIs) {
    for (const Quality quality : {Quality::Stale, Quality::Bad, Quality::Lost}) {
        rig_.tree().at("/tip").slot().quality = quality;
        rig_.moveTip(0.1);
        EXPECT_DOUBLE_EQ(rig_.target(), 0.5) << name(quality);
    }
}

// --- saved and restored -------------------------------------------------------------------------

TEST(ClutchThatLetGo, GoesOnTheSameAfterItsStateWasSavedAndRestored) {
    ClutchRig saved, fresh;
    saved.press(true);
    saved.setTurn("/tip", 0.1);
    saved.moveHand(0.3);
    fresh.press(false);
    fresh.press(true);
    ASSERT_FALSE(saved.engaged());
    ASSERT_TRUE(fresh.engaged());

    fresh.restore(saved.save());

    EXPECT_EQ(fresh.save(), saved.save());
    for (int i = 0; i < 50; ++i) {
        for (ClutchRig* rig : {&saved, &fresh}) {
            rig->tree().at("/button").data<bool>("value") = i < 20 || i > 25;
            rig->moveHand(0.3 + 1e-3 * i);
        }
        EXPECT_EQ(Rig::differences(saved.values(), fresh.values()), "") << i;
        EXPECT_EQ(fresh.engaged(), i > 25) << i;
    }
    EXPECT_EQ(fresh.save().kept, saved.save().kept);
}

}  // namespace
}  // namespace cortex::toolkit::test
