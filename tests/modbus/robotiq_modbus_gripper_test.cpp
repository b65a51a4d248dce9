// SPDX-License-Identifier: Apache-2.0
// Class RobotiqModbusGripper before the program cortex-gripper-sim. A BareClient beside it commands
// faults and looks at registers.
#include "gripper/robotiq_modbus_gripper.hpp"

#include "cortex/core/error.hpp"
#include "cortex/toolkit/classes.hpp"

#include "modbus/link_plant.hpp"
#include "modbus/sim_process.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace cortex::modbus::test {
namespace {

using toolkit::Link;

constexpr std::int64_t moving = 0, stoppedOpening = 1, stoppedClosing = 2, atDemand = 3;
constexpr std::int64_t ready = 1, faulty = 4, disabled = 6;
constexpr std::int64_t activated = 3;

class GripperPlant : public LinkPlant {
public:
    explicit GripperPlant(const std::string& address, const Pairs& given = {})
        : LinkPlant{{CORTEX_SOURCE_DIR "/ontology/cortex-morphology.xml"}, "/gripper", "/opening"} {
        toolkit::addClasses(classes());
        classes().add<RobotiqModbusGripper>("RobotiqModbusGripper");
        add("/wish", "Robotiq2FingerAxis");
        add("/opening", "LinearAxisObservation");
        add("/status", "GripperStatus");
        add("/gripper", "RobotiqModbusGripper",
            {{"demands", "/wish"}, {"opening", "/opening"}, {"status", "/status"}},
            linkSettings(address, given));
    }

    void send(const char* command) { cluster().send("/gripper", command); }
    void wish(double width, double force = 0, double speed = 0.12) {
        Simplex& demand = tree().at("/wish");
        demand.data<double>("position") = width;
        demand.data<double>("effort") = force;
        demand.data<double>("velocity") = speed;
    }
    // With a demand that is led to the fingers, as a controller does it.
    void begin() {
        makeActive();
        settle();
    }
    void begin(double width) {
        open();
        begin();
        wish(width);
    }
    void makeActive() {
        send("startup");
        stepUntil("Active", [&] {
            wish(this->width(), 0, 0);
            return state("/gripper") == State::Active;
        });
    }
    void stop(const char* command = "shutdown") {
        send(command);
        stepUntil("Standby", [&] { return state("/gripper") == State::Standby; });
    }
    void clearFaults() {
        step();  // in the cycle of a fault it is not over
        stop("clearFaults");
    }
    // Until what is wished has been told to the gripper, and that was read.
    void settle() { stepWithExchanges(3), step(); }
    void stepUntilObject(std::int64_t wanted) {
        settle();
        stepUntil("object " + std::to_string(wanted), [&] { return object() == wanted; });
    }

    double width() { return get<double>("/opening", "position"); }
    std::int64_t axisStatus() { return get<std::int64_t>("/opening", "status"); }
    std::int64_t object() { return get<std::int64_t>("/status", "object"); }
    double current() { return get<double>("/status", "current"); }
};

class RobotiqGripper : public testing::Test {
protected:
    Words asked() { return tool.read(1000, 3); }
    std::uint16_t faultOnce(std::uint16_t code) {
        return static_cast<std::uint16_t>(tool.write(0xF000, {code}));
    }

    SimProcess sim{{"--activation-time", "0.05"}, "cortex-gripper-sim"};
    BareClient tool{sim.port()};
    std::optional<GripperPlant> plant{std::in_place, sim.address()};
};

TEST_F(RobotiqGripper, IsSeenInStandbyAndToldNothing) {
    plant->open();
    plant->wish(0.02);
    plant->settle();

    EXPECT_EQ(plant->link(), Link::Open);
    EXPECT_NEAR(plant->width(), 0.085, 1e-3);
    EXPECT_EQ(plant->axisStatus(), disabled);
    EXPECT_EQ(plant->count("activation"), 0);
    EXPECT_EQ(asked(), (Words{0, 0, 0}));
}

TEST_F(RobotiqGripper, IsActivatedByAStartupButOnlyOnce) {
    plant->begin(0.085);
    EXPECT_EQ(plant->count("activation"), activated);
    EXPECT_EQ(plant->count("gripperFault"), 0);
    plant->settle();
    EXPECT_EQ(plant->axisStatus(), ready);

    plant->wish(0.06);
    plant->stepUntilObject(atDemand);
    plant->stop();
    plant->settle();
    EXPECT_EQ(plant->axisStatus(), disabled) << "it follows nobody";
    plant->send("startup");
    plant->stepUntil("Active", [&] {
        plant->wish(plant->width(), 0, 0);
        EXPECT_EQ(plant->count("activation"), activated);
        EXPECT_NEAR(plant->width(), 0.06, 1e-3) << "an activation would open it";
        return plant->state("/gripper") == State::Active;
    });
}

TEST_F(RobotiqGripper, OpensAndClosesWithinAMillimetre) {
    plant->begin(0.085);
    for (const double width : {0.06, 0.0, 0.0123}) {
        plant->wish(width);
        plant->stepUntilObject(atDemand);
        EXPECT_NEAR(plant->width(), width, 5e-4);
    }
    EXPECT_EQ(plant->object(), atDemand);
    EXPECT_EQ(plant->current(), 0);
    // Over the last answers that it took; beside other work it takes fewer than it exchanges.
    plant->stepUntil("rest", [&] { return plant->get<double>("/opening", "velocity") == 0; });
}

TEST_F(RobotiqGripper, FollowsADemandThatMovesAndTellsItsSpeed) {
    plant->begin(0.085);
    plant->wish(0.08, 0, 0);
    plant->stepUntilObject(atDemand);
    double fastest = 0;
    for (double width = 0.08; width > 0.05; width -= 0.001) {
        plant->wish(width, 0, -0.1);
        plant->stepWithExchanges(1);
        fastest = std::min(fastest, plant->get<double>("/opening", "velocity"));
    }
    plant->wish(0.05, 0, -0.01);
    plant->settle();
    plant->wish(0.05, 0, 0);
    plant->stepUntilObject(atDemand);
    EXPECT_NEAR(plant->width(), 0.05, 5e-4);
    EXPECT_LT(fastest, -0.01);
    EXPECT_EQ(asked()[2] >> 8, 206) << "1.25 x 0.1 m/s, also at its slow end";
}

TEST_F(RobotiqGripper, IsToldOctetsAsTheTableHasThem) {
    plant->begin(0.085);
    plant->wish(0.085, 0, 0);
    plant->settle();
    for (const auto& [force, octet] :
         {std::pair{0.0, 0}, {20.0, 0}, {127.5, 128}, {235.0, 255}, {1000.0, 255}, {-5.0, 0}}) {
        plant->wish(0.0425, force, 0.02);
        plant->settle();
        EXPECT_EQ(asked(), (Words{0x0900, 117, static_cast<std::uint16_t>(0x0A00 | octet)}))
            << force;
    }
}

TEST_F(RobotiqGripper, TellsAWorkPieceThatItHoldsAndOneThatIsLost) {
    EXPECT_EQ(tool.write(0xF001, {700}), 0);
    plant->begin(0.085);
    plant->wish(0.05, 100);
    plant->stepUntilObject(stoppedClosing);
    EXPECT_NEAR(plant->width(), 0.07, 5e-4);
    EXPECT_NEAR(plant->current(), 0.43, 0.02);
    EXPECT_EQ(plant->axisStatus(), ready);

    EXPECT_EQ(tool.write(0xF001, {0}), 0);
    plant->stepUntilObject(atDemand);
    EXPECT_NEAR(plant->width(), 0.05, 5e-4);

    EXPECT_EQ(tool.write(0xF002, {600}), 0);
    plant->wish(0.085);
    plant->stepUntilObject(stoppedOpening);
    EXPECT_NEAR(plant->width(), 0.06, 5e-4);
}

TEST_F(RobotiqGripper, DoesNotLetGoOfAWorkPieceUnlessItIsToOpen) {
    EXPECT_EQ(tool.write(0xF001, {700}), 0);
    plant->begin(0.085);
    plant->wish(0, 100);
    plant->stepUntilObject(stoppedClosing);
    const Words held = asked();

    plant->wish(plant->width());  // as a controller begins after a loss
    plant->settle();
    EXPECT_EQ(asked(), held);
    plant->stop();
    plant->wish(0.085);
    plant->settle();
    EXPECT_EQ(asked(), held) << "in Standby nothing is passed on";
    plant->wish(plant->width());
    plant->makeActive();
    plant->settle();
    EXPECT_EQ(asked(), held);
    EXPECT_EQ(plant->object(), stoppedClosing);

    plant->wish(0.08);
    plant->stepUntilObject(atDemand);
    EXPECT_NEAR(plant->width(), 0.08, 5e-4);
}

TEST_F(RobotiqGripper, SaysMovingWhileAnotherDemandIsUnderWay) {
    plant->begin(0.085);
    plant->wish(0.08);
    plant->stepUntilObject(atDemand);
    EXPECT_EQ(tool.write(0xF100, {50, 2}), 0);
    plant->wish(0.07);
    plant->step();
    EXPECT_EQ(plant->object(), moving) << "the gripper has not been told yet";
    plant->stepUntil("its end", [&] { return plant->object() == atDemand; });
    EXPECT_NEAR(plant->width(), 0.07, 5e-4);
}

TEST_F(RobotiqGripper, IsInFaultByNameWhenItLosesItsPowerAndIsNotActivatedByItself) {
    plant->open();
    for (int round = 1; round <= 5; ++round) {  // also between a look at it and what is told to it
        SCOPED_TRACE(round);
        plant->begin();
        plant->wish(0.07);
        plant->stepUntilObject(atDemand);
        plant->wish(0.065);
        plant->step(round);
        EXPECT_EQ(tool.write(0xF003, {1}), 0);
        plant->stepUntil("Fault", [&] { return plant->state("/gripper") == State::Fault; });
        EXPECT_TRUE(plant->hasTold("the gripper is not activated any more")) << plant->events();
        plant->settle();
        EXPECT_EQ(asked()[0], 0) << "nothing moves by itself";
        EXPECT_EQ(plant->count("activation"), 0);
        EXPECT_EQ(plant->axisStatus(), disabled);

        plant->clearFaults();
        plant->settle();
        EXPECT_EQ(asked()[0], 0);
        EXPECT_EQ(plant->count("activation"), 0);
    }
    plant->begin();
    plant->wish(0.07);
    plant->stepUntilObject(atDemand);
    EXPECT_NEAR(plant->width(), 0.07, 5e-4);
}

TEST_F(RobotiqGripper, IsLostWhenItIsKilledAndWaitsForAPersonWhenItIsBack) {
    plant->begin(0.07);
    plant->stepUntilObject(atDemand);

    sim.kill9();
    plant->stepUntil("a lost gripper", [&] { return plant->quality() == Quality::Lost; });
    EXPECT_EQ(plant->state("/gripper"), State::Active) << "a lost link is no fault";
    EXPECT_NEAR(plant->width(), 0.07, 5e-4) << "the last one that came";

    sim.restart();
    plant->stepUntil("a present answer", [&] { return plant->quality() == Quality::Good; });
    plant->stepUntil("Fault", [&] { return plant->state("/gripper") == State::Fault; });
    EXPECT_EQ(BareClient{sim.port()}.read(1000, 3), (Words{0, 0, 0}));
    EXPECT_NEAR(plant->width(), 0.085, 1e-3) << "another life of the gripper";

    plant->clearFaults();
    plant->begin();
    plant->wish(0.07);
    plant->stepUntilObject(atDemand);
    EXPECT_NEAR(plant->width(), 0.07, 5e-4);
}

TEST_F(RobotiqGripper, FollowsADemandThatWasLostOnlyOnceItRestsAtTheFingers) {
    plant->begin(0.06);
    plant->stepUntilObject(atDemand);
    for (const int cycles : {1, 50}) {
        plant->wish(0.02, 0, 0);
        plant->tree().at("/wish").slot().quality = Quality::Lost;
        plant->step(cycles);
        plant->tree().at("/wish").slot().quality = Quality::Good;
        plant->settle();
        EXPECT_EQ(plant->axisStatus(), disabled);
        EXPECT_NEAR(plant->width(), 0.06, 1e-3);

        plant->wish(0.06, 0, 0);
        plant->settle();
        EXPECT_EQ(plant->axisStatus(), ready);
    }
    plant->wish(0.03);
    plant->stepUntilObject(atDemand);
    EXPECT_NEAR(plant->width(), 0.03, 1e-3);
}

TEST_F(RobotiqGripper, BeginsNothingBeforeAControllerHasLedItsDemandToTheFingers) {
    plant.emplace(sim.address(), GripperPlant::Pairs{{"stroke", "0.005"}});
    plant->add("/hold", "HoldAxisController", {{"axes", "/opening"}, {"demands", "/wish"}});
    plant->open();
    plant->send("startup");
    plant->stepUntil("an activation", [&] { return plant->count("activation") == activated; });
    plant->settle();
    EXPECT_EQ(plant->state("/gripper"), State::StartingUp) << "its demand is closed, 5 mm away";
    EXPECT_EQ(plant->axisStatus(), disabled);
    EXPECT_EQ(asked(), (Words{0x0100, 0, 0})) << "activated, and told nothing else";

    plant->cluster().send("/hold", "startup");
    plant->stepUntil("a demand", [&] { return asked()[0] == 0x0900; });
    EXPECT_EQ(plant->state("/gripper"), State::Active);
    EXPECT_NEAR(plant->width(), 0.005, 1e-4) << "where it stood";
}

TEST_F(RobotiqGripper, TellsWhatItComplainsOfInWords) {
    plant->begin(0.07);
    EXPECT_EQ(faultOnce(9), 0);
    plant->stepUntil("code 9", [&] { return plant->count("gripperFault") == 9; });
    plant->settle();
    EXPECT_EQ(plant->state("/gripper"), State::Active) << "it obeys";
    EXPECT_TRUE(plant->hasTold("the gripper says: it heard nobody for a second"));

    EXPECT_EQ(faultOnce(0xE), 0);
    plant->stepUntil("Fault", [&] { return plant->state("/gripper") == State::Fault; });
    EXPECT_TRUE(plant->hasTold("the gripper says: its current was too high")) << plant->events();
    plant->settle();
    EXPECT_EQ(plant->axisStatus(), faulty);

    plant->clearFaults();
    plant->makeActive();
    EXPECT_EQ(plant->count("gripperFault"), 0) << "the startup has reset it";
    plant->stepUntilObject(atDemand);
}

TEST(RobotiqGripperElsewhere, IsRefusedWhereAnotherDeviceAnswers) {
    SimProcess drive;
    GripperPlant plant{drive.address()};
    plant.start();
    plant.stepUntil("a refusal", [&] { return plant.link() == Link::Refused; });
    plant.stepUntil("its reason", [&] { return plant.hasTold("illegal data address"); });
    EXPECT_EQ(plant.quality(), Quality::Lost);
}

TEST_F(RobotiqGripper, IsClosedAndOpenedAgainAfterAnExceptionAndWhenItIsLate) {
    plant->begin(0.085);
    EXPECT_EQ(tool.write(0xF100, {0, 0, 6, 1}), 0);
    plant->stepUntil("its reason", [&] { return plant->hasTold("(exception 4)"); });
    plant->stepUntil("a present answer", [&] { return plant->count("reconnectCount") >= 1; });
    plant->stepUntil("a present answer", [&] { return plant->quality() == Quality::Good; });
    plant->settle();
    EXPECT_EQ(plant->state("/gripper"), State::Active) << "it is still activated";
    const Words before = asked();
    plant->wish(0.07, 0, 0);
    plant->settle();
    EXPECT_EQ(asked(), before) << "a demand that went on meanwhile is not caught up with";
    EXPECT_EQ(plant->axisStatus(), disabled) << "so that its controller leads the demand back";

    plant->wish(plant->width(), 0, 0);
    plant->settle();
    EXPECT_EQ(plant->axisStatus(), ready);
    plant->wish(0.07);
    plant->stepUntilObject(atDemand);
    EXPECT_NEAR(plant->width(), 0.07, 5e-4);
}

TEST(RobotiqGripperElsewhere, IsRefusedWithSettingsThatContradictEachOther) {
    GripperPlant wrong{"127.0.0.1", {{"octetOpen", "230"}}};
    try {
        wrong.start();
        FAIL() << "it started";
    } catch (const Error& error) {
        EXPECT_NE(std::string{error.what()}.find("/gripper: octetOpen is 230 and octetClosed 230"),
                  std::string::npos)
            << error.what();
    }
}

}  // namespace
}  // namespace cortex::modbus::test
