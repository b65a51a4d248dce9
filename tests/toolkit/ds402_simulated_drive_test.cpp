// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agent.hpp"
#include "cortex/drives/ds402_state.hpp"
#include "cortex/toolkit/fieldbus_link.hpp"

#include "rig.hpp"

#include <cmath>
#include <memory>
#include <mutex>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

using drives::Ds402State;

// A drive of one axis, whose demand is written by the test.
class WordedDrive : public Rig {
public:
    explicit WordedDrive(const Pairs& device = {}, const Pairs& observation = {}) {
        add("/axis", "Ds402RotaryObservation", {}, observation);
        add("/demand", "Ds402RotaryModification");
        add("/it", "Ds402SimulatedDrive", {{"demands", "/demand"}, {"observations", "/axis"}},
            device);
    }
    void boot() {
        cluster().addEventSink([told = told_](const Event& event, const Structure&) {
            const std::lock_guard lock{told->mutex};
            told->text += std::string{event.text.view()} + "\n";
        });
        start();
        step(60);  // self test
    }
    void send(std::int64_t word, std::int64_t cycles = 60) {
        tree().at("/demand").data<std::int64_t>("controlWord") = word;
        step(cycles);
    }
    void enable(std::int64_t mode = 8) {
        boot();
        wish("mode", mode);
        send(0x06);
        send(0x0F);
        ASSERT_EQ(driveState(), Ds402State::OperationEnabled);
    }
    void demand(const std::string& item, double value) {
        tree().at("/demand").data<double>(item) = value;
    }
    void wish(const std::string& item, std::int64_t value) {
        tree().at("/demand").data<std::int64_t>(item) = value;
    }
    Ds402State driveState() {
        return static_cast<Ds402State>(get<std::int64_t>("/axis", "driveState"));
    }
    double position() { return get<double>("/axis", "position"); }
    std::string told() {
        cluster().agent().events().flush();
        const std::lock_guard lock{told_->mutex};
        return told_->text;
    }

private:
    struct Told {
        std::mutex mutex;
        std::string text;
    };
    std::shared_ptr<Told> told_ = std::make_shared<Told>();
};

TEST(Ds402SimulatedDrive, IsActiveWhenItsSelfTestIsOver) {
    WordedDrive rig;
    rig.start();
    rig.cluster().send("/it", "startup");
    rig.step(30);
    EXPECT_EQ(rig.state("/it"), State::StartingUp);
    EXPECT_EQ(rig.driveState(), Ds402State::NotReadyToSwitchOn);
    rig.step(40);
    EXPECT_EQ(rig.state("/it"), State::Active);
    EXPECT_EQ(rig.driveState(), Ds402State::SwitchOnDisabled);
}

TEST(Ds402SimulatedDrive, HasALinkThatIsOpenAndCountsItsSteps) {
    WordedDrive rig;
    rig.start();
    rig.step(9);
    EXPECT_EQ(rig.get<std::int64_t>("/it", "link"), static_cast<std::int64_t>(Link::Open));
    EXPECT_EQ(rig.get<std::int64_t>("/it", "exchangeCount"), rig.cycle());
    EXPECT_TRUE(rig.call("/it", "reconnect").done());
    EXPECT_EQ(rig.get<std::int64_t>("/it", "reconnectCount"), 1);
    EXPECT_EQ(rig.get<std::int64_t>("/it", "errorCount"), 0);
}

TEST(Ds402SimulatedDrive, PassesItsDemandInStandbyToo) {
    WordedDrive rig;
    rig.enable();
    EXPECT_EQ(rig.state("/it"), State::Standby);
    for (int i = 1; i <= 400; ++i) {
        rig.demand("position", 0.1 * std::sin(0.005 * i));
        rig.demand("velocity", 0.5 * std::cos(0.005 * i));
        rig.step();
    }
    EXPECT_NEAR(rig.position(), 0.1 * std::sin(2.0), 2e-3);
    EXPECT_NEAR(rig.get<double>("/axis", "velocity"), 0.5 * std::cos(2.0), 0.02);
    EXPECT_NEAR(rig.get<double>("/axis", "acceleration"), -2.5 * std::sin(2.0), 1);
    EXPECT_EQ(rig.get<std::int64_t>("/axis", "modeDisplay"), 8);
    EXPECT_EQ(rig.get<std::int64_t>("/axis", "status"), 5) << "it is not homed";
    EXPECT_TRUE(rig.get<bool>("/axis", "voltageEnabled"));
    EXPECT_TRUE(rig.get<bool>("/axis", "remote"));
}

TEST(Ds402SimulatedDrive, StopsQuicklyWithoutALossOfItsOwnWhenItsDemandIsLost) {
    WordedDrive rig;
    rig.enable();
    rig.tree().at("/demand").slot().quality = Quality::Lost;
    rig.step(2);
    EXPECT_EQ(rig.driveState(), Ds402State::QuickStopActive);
    EXPECT_EQ(rig.tree().at("/axis").slot().quality, Quality::Good);
    rig.step(100);
    EXPECT_EQ(rig.driveState(), Ds402State::SwitchOnDisabled);
    EXPECT_EQ(rig.get<std::int64_t>("/axis", "status"), 6) << "without power";
}

TEST(Ds402SimulatedDrive, GoesIntoTheFaultThatIsInjectedAndIsResetByAnEdge) {
    WordedDrive rig;
    rig.enable();
    EXPECT_TRUE(rig.call("/it", "injectFault", {{"code", std::int64_t{0x2310}}}).done());
    rig.step(100);
    EXPECT_EQ(rig.driveState(), Ds402State::Fault);
    EXPECT_EQ(rig.get<std::int64_t>("/axis", "errorCode"), 0x2310);
    EXPECT_EQ(rig.get<std::int64_t>("/axis", "status"), 4);
    EXPECT_EQ(rig.state("/it"), State::Standby) << "the device itself is well";
    rig.send(0x80);
    EXPECT_EQ(rig.driveState(), Ds402State::SwitchOnDisabled);
    EXPECT_EQ(rig.get<std::int64_t>("/axis", "errorCode"), 0);
}

TEST(Ds402SimulatedDrive, RejectsCommandsForAnAxisThatItHasNot) {
    WordedDrive rig;
    rig.boot();
    const std::int64_t second = 2;
    for (const CallResult& result :
         {rig.call("/it", "injectFault", {{"axis", second}}),
          rig.call("/it", "jumpEncoder", {{"axis", second}, {"by", 0.1}})}) {
        EXPECT_EQ(result.outcome, Outcome::Rejected);
        EXPECT_EQ(result.why, "there is no axis 2, there is 1");
    }
}

TEST(Ds402SimulatedDrive, IsNotHomedAfterItsEncoderHasJumped) {
    WordedDrive rig;
    rig.enable(6);
    rig.demand("homeOffset", 1.5);
    rig.send(0x1F);
    EXPECT_TRUE(rig.get<bool>("/axis", "homed"));
    EXPECT_EQ(rig.position(), 1.5) << "method 37: where it stands";
    EXPECT_TRUE(rig.call("/it", "jumpEncoder", {{"axis", std::int64_t{1}}, {"by", -0.5}}).done());
    rig.step();
    EXPECT_FALSE(rig.get<bool>("/axis", "homed"));
    EXPECT_NEAR(rig.position(), 1, 1e-5);
}

TEST(Ds402SimulatedDrive, FeelsLoadAndFrictionAsSharesOfItsRatedEffort) {
    WordedDrive rig{{}, {{"ratedEffort", "20"}, {"homingNeeded", "false"}}};
    rig.enable();
    const Value load{std::vector{50.0, 0.0}};
    EXPECT_TRUE(rig.call("/it", "set", {{"load", load}}).done());
    rig.step(500);
    EXPECT_NEAR(rig.get<double>("/axis", "effort"), 10, 0.3);
    EXPECT_NEAR(rig.position(), 0, 1e-3);
    EXPECT_EQ(rig.get<std::int64_t>("/axis", "status"), 1);
    EXPECT_TRUE(rig.call("/it", "set", {{"load", Value{std::vector{400.0, 0.0}}}}).done());
    rig.step(500);
    EXPECT_EQ(rig.get<std::int64_t>("/axis", "errorCode"), 0x8611) << "it cannot hold that";
}

TEST(Ds402SimulatedDrive, StopsHardWhereSomethingIsInItsWay) {
    WordedDrive rig{{}, {{"homingNeeded", "false"}}};
    rig.enable();
    const auto stop = [&](double least, double greatest) {
        return rig.call("/it", "set", {{"stops", Value{std::vector{least, greatest, 0.0, 0.0}}}});
    };
    EXPECT_TRUE(stop(-1, 0.02).done());
    rig.demand("position", 0.021);
    rig.step(200);
    EXPECT_NEAR(rig.position(), 0.02, 1e-5);
    EXPECT_GT(rig.get<double>("/axis", "effort"), 1);
    EXPECT_TRUE(stop(0, 0).done());
    rig.step(500);
    EXPECT_NEAR(rig.position(), 0.021, 1e-4);
    EXPECT_EQ(stop(0.2, 0.1).why, "stops: the least place of an axis is above its greatest");
}

TEST(Ds402SimulatedDrive, StaysAsItIsSetWhereAWishIsWrongAndSaysSoOnce) {
    WordedDrive rig;
    rig.enable(6);
    rig.demand("homingSpeed", 0);
    rig.wish("homingMethod", 17);
    rig.send(0x1F, 100);
    EXPECT_TRUE(rig.get<bool>("/axis", "homed")) << "by method 37, as before";
    EXPECT_EQ(rig.told(),
              "axis 1 is not set anew: an option is unknown, or a homing speed is not above 0\n");
}

TEST(Ds402SimulatedDrive, DoesNotStartWithSettingsThatCannotBe) {
    WordedDrive rig{{{"softLimits", "1 -1 0 0"}}};
    try {
        rig.start();
        FAIL() << "it started";
    } catch (const Error& error) {
        EXPECT_NE(std::string{error.what()}.find(
                      "/it, axis 1: The least position (607D:1) is above the greatest (607D:2)"),
                  std::string::npos)
            << error.what();
    }
}

TEST(Ds402SimulatedDrive, SaysDisabledWhileItsAxisIsHeld) {
    WordedDrive rig{{}, {{"homingNeeded", "false"}}};
    rig.enable();
    EXPECT_EQ(rig.get<std::int64_t>("/axis", "status"), 1);
    rig.tree().at("/demand").data<bool>("waits") = true;
    rig.step(2);
    EXPECT_EQ(rig.driveState(), Ds402State::OperationEnabled);
    EXPECT_EQ(rig.get<std::int64_t>("/axis", "status"), 6);
}

TEST(Ds402SimulatedDrive, StandsFirstWhereItIsToStart) {
    WordedDrive rig{{{"startPosition", "0.7 0"}}};
    rig.start();
    EXPECT_NEAR(rig.position(), 0.7, 1e-5);
}

TEST(Ds402SimulatedDrive, MovesTwoAxesThatKnowNothingOfEachOther) {
    Rig rig;
    Rig::Pairs relates;
    for (const std::string name : {"a", "b"}) {
        rig.add("/axis/" + name, "Ds402LinearObservation");
        rig.add("/demand/" + name, "Ds402LinearModification");
        relates.emplace_back("demands", "/demand/" + name);
        relates.emplace_back("observations", "/axis/" + name);
    }
    rig.add("/it", "Ds402SimulatedDrive", relates);
    rig.start();
    rig.step(60);
    for (const std::int64_t word : {0x06, 0x0F}) {
        rig.tree().at("/demand/b").data<std::int64_t>("controlWord") = word;
        rig.step(60);
    }
    rig.tree().at("/demand/b").data<double>("position") = 0.05;
    rig.step(400);
    EXPECT_EQ(rig.get<double>("/axis/a", "position"), 0);
    EXPECT_NEAR(rig.get<double>("/axis/b", "position"), 0.05, 2e-5);
    EXPECT_TRUE(rig.call("/it", "injectFault", {{"axis", std::int64_t{2}}}).done());
    rig.step(100);
    EXPECT_EQ(rig.get<std::int64_t>("/axis/b", "driveState"), 8);
    EXPECT_EQ(rig.get<std::int64_t>("/axis/a", "driveState"), 2);
}

}  // namespace
}  // namespace cortex::toolkit::test
