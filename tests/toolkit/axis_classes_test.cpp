// SPDX-License-Identifier: Apache-2.0
#include "mechanics/lbr_chain.hpp"
#include "rig.hpp"

#include <cmath>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

using mechanics::test::radians;

constexpr double axis1Speed = 85 * std::numbers::pi / 180;

class OneDrive : public testing::Test {
protected:
    void begin(const std::string& startPosition = "0") {
        rig_.add("/demand", "KukaLbrAxis1");
        rig_.add("/axis", "KukaLbrAxis1");
        rig_.add("/drive", "SimulatedAxis", {{"demand", "/demand"}, {"observation", "/axis"}},
                 {{"startPosition", startPosition}});
        rig_.start();
        demand_ = rig_.tree().at("/demand").data<double>("position");
        demandSpeed_ = rig_.tree().at("/demand").data<double>("velocity");
    }
    double position() { return rig_.get<double>("/axis", "position"); }
    double velocity() { return rig_.get<double>("/axis", "velocity"); }

    Rig rig_;
    Data<double> demand_, demandSpeed_;
};

using SimulatedAxis = OneDrive;

TEST_F(SimulatedAxis, StandsAtItsStartFromTheFirstCycle) {
    begin("0.3");

    EXPECT_DOUBLE_EQ(position(), 0.3);
}

// As in a world with physics, so that one can take the place of the other.
TEST(AnObservationThatIsGivenAPosition, IsWhereItsSimulatedAxisStands) {
    const auto plant = [](const std::string& startPosition) {
        auto rig = std::make_unique<Rig>();
        rig->add("/demand", "KukaLbrAxis1");
        rig->add("/axis", "KukaLbrAxis1", {}, {{"position", "0.3"}});
        rig->add(
            "/drive", "SimulatedAxis", {{"demand", "/demand"}, {"observation", "/axis"}},
            startPosition.empty() ? Rig::Pairs{} : Rig::Pairs{{"startPosition", startPosition}});
        rig->start();
        return rig;
    };
    EXPECT_EQ(plant("")->get<double>("/axis", "position"), 0.3);
    EXPECT_EQ(plant("0.3")->get<double>("/axis", "position"), 0.3);
    try {
        plant("0.5");
        ADD_FAILURE() << "it has to choose one of two";
    } catch (const Error& error) {
        EXPECT_EQ(
            std::string{error.what()},
            "/drive: startPosition is 0.5, and position of /axis is given as 0.3: give one of "
            "the two\n");
    }
}

TEST_F(SimulatedAxis, DoesNotMoveUnlessActive) {
    begin();
    demand_ = 0.5;

    rig_.step(500);

    EXPECT_EQ(position(), 0);
}

TEST_F(SimulatedAxis, DoesNotSwitchOnWhileTheDemandIsElsewhere) {
    begin();
    demand_ = 0.5;
    rig_.cluster().send("/drive", "startup");
    rig_.step(500);
    EXPECT_EQ(rig_.state("/drive"), State::StartingUp);

    demand_ = 0.001;
    rig_.step(5);

    EXPECT_EQ(rig_.state("/drive"), State::Active);
}

TEST_F(SimulatedAxis, ReachesADemandNoFasterThanItsAxisMay) {
    begin();
    rig_.startUp();
    demand_ = 1.0;
    double fastest = 0;
    double before = position();
    for (int i = 0; i < 2000; ++i) {
        rig_.step();
        fastest = std::max(fastest, std::abs(position() - before) * 1e3);
        before = position();
    }

    EXPECT_NEAR(position(), 1.0, 1e-6);
    EXPECT_LE(fastest, axis1Speed * (1 + 1e-9));
    EXPECT_GT(fastest, axis1Speed * 0.99);
    EXPECT_EQ(rig_.get<std::int64_t>("/drive", "limitCount"), 1);
}

TEST_F(SimulatedAxis, IsSlowerThanItsDemandWithoutVelocityAndNotWithIt) {
    begin();
    rig_.startUp();
    double lag = 0;
    for (const double forward : {0.0, 0.5}) {
        demandSpeed_ = forward;
        for (int i = 0; i < 500; ++i) {
            demand_ += 0.5e-3;
            rig_.step();
        }
        lag = demand_ - position();
        if (forward == 0) {
            EXPECT_GT(lag, 0.5 * 0.01);  // 2 d / w = 24 ms, less one period
        }
    }

    EXPECT_NEAR(lag, 0, 1e-3);
}

TEST_F(SimulatedAxis, StaysWithinItsRange) {
    begin("2.9");
    demand_ = 2.9;
    rig_.startUp();
    demand_ = 4.0;

    rig_.step(1000);

    EXPECT_DOUBLE_EQ(position(), radians(170));
    EXPECT_EQ(velocity(), 0);
    EXPECT_EQ(rig_.get<std::int64_t>("/axis", "status"), 3);
}

TEST_F(SimulatedAxis, BrakesWhenItIsShutDownInMotion) {
    begin();
    rig_.startUp();
    demand_ = 1.0;
    rig_.step(200);
    ASSERT_GT(velocity(), 1.0);

    rig_.call("/drive", "shutdown");
    rig_.step(300);
    const double resting = position();
    rig_.step(100);

    EXPECT_NEAR(position(), resting, 1e-6);
    EXPECT_LT(position(), 0.9);
}

// --- Controllers with a drive of their own -----------------------------------------------------

class OneController : public testing::Test {
protected:
    void begin(const std::string& type) {
        rig_.add("/demand", "KukaLbrAxis1");
        rig_.add("/axis", "KukaLbrAxis1");
        rig_.add("/drive", "SimulatedAxis", {{"demand", "/demand"}, {"observation", "/axis"}},
                 {{"startPosition", "0.2"}});
        rig_.add("/controller", type, {{"axes", "/axis"}, {"demands", "/demand"}});
        rig_.start();
        rig_.startUp();
    }
    CallResult jog(std::int64_t axis, double velocity) {
        return rig_.call(
            "/controller", "jog",
            {{"axis", Value{std::vector{axis}}}, {"velocity", Value{std::vector{velocity}}}});
    }
    Rig rig_;
};

TEST_F(OneController, HoldKeepsTheAxisWhereItWas) {
    begin("HoldAxisController");
    rig_.step(1000);

    EXPECT_NEAR(rig_.get<double>("/demand", "position"), 0.2, 1e-12);
    EXPECT_NEAR(rig_.get<double>("/axis", "position"), 0.2, 1e-9);
}

TEST_F(OneController, JogMovesForItsHoldTimeOnly) {
    begin("JogController");

    EXPECT_TRUE(jog(1, 0.4).done());
    rig_.step(10);
    EXPECT_TRUE(rig_.get<bool>("/controller", "jogging"));
    rig_.step(1000);

    EXPECT_FALSE(rig_.get<bool>("/controller", "jogging"));
    EXPECT_NEAR(rig_.get<double>("/axis", "position"), 0.2 + 0.25 * 0.4, 2e-3);
}

TEST_F(OneController, JogRefusesAnAxisThatIsNotThere) {
    begin("JogController");

    const CallResult answer = jog(2, 0.1);

    EXPECT_EQ(answer.outcome, Outcome::Rejected);
    EXPECT_EQ(answer.reason, Reason::Range);
}

TEST_F(OneController, PoseArrivesAndSaysSo) {
    begin("AxisPoseController");
    std::vector<double> pose(16);
    pose[0] = -0.7;
    EXPECT_TRUE(rig_.call("/controller", "set", {{"pose", Value{pose}}}).done());

    const CallResult answer =
        rig_.call("/controller", "moveTo", {{"speedShare", Value{std::vector{0.5}}}});
    rig_.step(200);

    EXPECT_TRUE(answer.done()) << answer.text();
    EXPECT_NEAR(rig_.get<double>("/axis", "position"), -0.7, 1e-4);
    EXPECT_EQ(rig_.get<double>("/demand", "velocity"), 0);
}

TEST_F(OneController, PoseOutOfRangeIsRejectedWithItemValueAndLimit) {
    begin("AxisPoseController");
    EXPECT_TRUE(
        rig_.call("/controller", "set", {{"pose", Value{std::vector<double>(16, 3.0)}}}).done());

    const CallResult answer = rig_.call("/controller", "moveTo");

    EXPECT_EQ(answer.outcome, Outcome::Rejected);
    EXPECT_EQ(answer.reason, Reason::Range);
    EXPECT_EQ(answer.why, "pose[0] is 3, above 2.96706, the limit of /demand");
    EXPECT_NEAR(rig_.get<double>("/axis", "position"), 0.2, 1e-9);
}

// What they write as acceleration is what their velocity changes by.
TEST_F(OneController, PoseDemandsAndTheDriveMeasuresTheAcceleration) {
    begin("AxisPoseController");
    std::vector<double> pose(16);
    pose[0] = -0.7;
    EXPECT_TRUE(rig_.call("/controller", "set", {{"pose", Value{pose}}}).done());
    rig_.cluster().send("/controller", "moveTo", {{"speedShare", 0.5}});
    double demanded = 0, measured = 0, greatest = 0;
    for (int i = 0; i < 2000; ++i) {
        rig_.step();
        const double demand = rig_.get<double>("/demand", "velocity");
        const double axis = rig_.get<double>("/axis", "velocity");
        const double change = (demand - demanded) * 1e3;
        const double wanted = rig_.get<double>("/demand", "acceleration");
        greatest = std::max(greatest, std::abs(wanted));
        EXPECT_LE(std::abs(change), greatest * (1 + 1e-6));
        EXPECT_NEAR(rig_.get<double>("/axis", "acceleration"), (axis - measured) * 1e3, 1e-9);
        demanded = demand;
        measured = axis;
    }

    EXPECT_GT(greatest, 1);
    EXPECT_EQ(rig_.get<double>("/demand", "acceleration"), 0);
}

TEST(SineController, MovesAVirtualAxis) {
    Rig rig;
    rig.add("/axis", "VirtualAxis");
    rig.add("/sine", "SineController", {{"axis", "/axis"}},
            {{"amplitude", "0.5"}, {"frequency", "1"}});
    rig.start();
    rig.startUp();
    double greatest = 0;
    for (int i = 0; i < 1000; ++i) {
        rig.step();
        const double position = rig.get<double>("/axis", "position");
        greatest = std::max(greatest, position);
        EXPECT_NEAR(rig.get<double>("/axis", "acceleration"),
                    -4 * std::numbers::pi * std::numbers::pi * position, 1e-9);
    }

    EXPECT_NEAR(greatest, 0.5, 1e-4);
}

}  // namespace
}  // namespace cortex::toolkit::test
