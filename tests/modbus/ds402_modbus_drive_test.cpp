// SPDX-License-Identifier: Apache-2.0
// Class Ds402ModbusDrive before the program cortex-ds402-sim: in order, and with each fault of the
// link. A BareClient beside it commands the faults and looks at registers.
#include "cortex/core/error.hpp"

#include "drive/ds402_registers.hpp"
#include "modbus/ds402_link_plant.hpp"

#include <cmath>
#include <csignal>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace cortex::modbus::test {
namespace {

using toolkit::Link;

constexpr std::int64_t switchOnDisabled = 2, operationEnabled = 5;  // of driveState
const LinkPlantOptions alone{{}, {}, false};

class Ds402Link : public testing::Test {
protected:
    SimProcess sim{{"--axes", "2", "--absolute"}};
    BareClient tool{sim.port()};
};

TEST_F(Ds402Link, ShowsADriveInStandbyAndWritesItsParameters) {
    Ds402LinkPlant plant{sim,
                         {{{"followingErrorWindow", "0.2 0.05"},
                           {"softLimits", "-1 1 0 0"},
                           {"abortOption", "3 1"},
                           {"watchdogTime", "0.25"}},
                          {},
                          false}};
    plant.open();
    plant.stepUntil("the end of its self test",
                    [&] { return plant.driveState() == switchOnDisabled; });

    EXPECT_EQ(plant.link(), Link::Open);
    EXPECT_EQ(plant.state("/drive"), State::Standby) << "no start is needed";
    EXPECT_TRUE(plant.get<bool>("/drive/a", "voltageEnabled"));
    EXPECT_TRUE(plant.get<bool>("/drive/b", "remote"));
    EXPECT_TRUE(plant.get<bool>("/drive/a", "homed")) << "it has an absolute encoder";
    EXPECT_NEAR(plant.get<double>("/drive/a", "temperature"), 25, 1);
    EXPECT_EQ(tool.read(0x100C, 2), (Words{0, 20000})) << "6065";
    EXPECT_EQ(tool.read(0x110C, 2), (Words{0, 5000}));
    EXPECT_EQ(tool.read(0x1014, 4), (Words{0xFFFE, 0x7960, 0x0001, 0x86A0})) << "607D";
    EXPECT_EQ(tool.read(0x100A, 2), (Words{0, 3})) << "6007";
    EXPECT_EQ(tool.read(0x2000, 1), (Words{250}));
}

TEST_F(Ds402Link, WritesWhatIsWishedWheneverItIsAnotherThing) {
    Ds402LinkPlant plant{sim, alone};
    plant.open();
    EXPECT_EQ(tool.read(0x1022, 2), (Words{0, 37})) << "6098, as /set/a has it";

    plant.tree().at("/set/a").data<std::int64_t>("homingMethod") = -3;
    plant.tree().at("/set/a").data<std::int64_t>("quickStopOption") = 6;
    plant.tree().at("/set/b").data<double>("homingSpeed") = 0.3;
    plant.stepWithExchanges(3);

    EXPECT_EQ(tool.read(0x1022, 2), (Words{0xFFFF, 0xFFFD}));
    EXPECT_EQ(tool.read(0x1000, 2), (Words{0, 6}));
    EXPECT_EQ(tool.read(0x1124, 2), (Words{0, 30000}));
    EXPECT_EQ(plant.count("errorCount"), 0);
}

TEST_F(Ds402Link, TellsAWishThatTheDriveRefusesOnceAndGoesOn) {
    Ds402LinkPlant plant{sim, alone};
    plant.open();

    plant.tree().at("/set/a").data<double>("homingSpeed") = 0;
    plant.stepWithExchanges(20);
    plant.step();

    const std::string words = "/drive/a: the drive refuses the homing speed that is wished";
    const std::string events = plant.events();
    EXPECT_NE(events.find(words), std::string::npos) << events;
    EXPECT_EQ(events.find(words), events.rfind(words)) << "once";
    EXPECT_EQ(plant.link(), Link::Open);
    EXPECT_EQ(plant.count("errorCount"), 0);
}

TEST_F(Ds402Link, SendsTheNearestOfATargetThatRegistersCannotHoldAndTellsIt) {
    Ds402LinkPlant plant{sim, alone};
    plant.open();

    plant.tree().at("/set/a").data<double>("position") = 1e6;
    plant.tree().at("/set/a").data<double>("velocity") = -1e6;
    plant.tree().at("/set/b").data<double>("position") = -0.5;
    plant.stepWithExchanges(3);
    plant.step();

    EXPECT_EQ(tool.read(0x0002, 4), (Words{0x7FFF, 0xFFFF, 0x8000, 0x0000}));
    EXPECT_EQ(tool.read(0x0012, 2), (Words{0xFFFF, 0x3CB0}));
    EXPECT_TRUE(plant.hasTold("/drive/a: a target is beyond what the drive's registers hold"))
        << plant.events();
    EXPECT_FALSE(plant.hasTold("/drive/b: a target")) << plant.events();
}

TEST_F(Ds402Link, KeepsTheLastStateBesideAWordThatMeansNoneAndTellsItOnce) {
    Ds402LinkPlant plant{sim, alone};
    plant.open();
    plant.stepUntil("the end of its self test",
                    [&] { return plant.driveState() == switchOnDisabled; });

    EXPECT_EQ(tool.write(0xF00D, {0x0001}), 0);
    plant.stepWithExchanges(10);
    plant.step();

    EXPECT_EQ(plant.driveState(), switchOnDisabled);
    EXPECT_EQ(plant.get<std::int64_t>("/drive/a", "statusWord"), 1);
    const std::string words = "/drive/a: status word 1 means no state; the last one stays";
    const std::string events = plant.events();
    EXPECT_NE(events.find(words), std::string::npos) << events;
    EXPECT_EQ(events.find(words), events.rfind(words)) << "once";
}

TEST_F(Ds402Link, IsLedByItsProcessorAndFollowsDemands) {
    Ds402LinkPlant plant{sim};
    plant.open();
    plant.makeActive();
    EXPECT_EQ(plant.driveState(), operationEnabled);

    plant.moveTo(0.05);

    EXPECT_NEAR(plant.position(), 0.05, 1e-3);
    EXPECT_NEAR(plant.get<double>("/drive/b", "position"), 0, 1e-3);
    EXPECT_EQ(tool.read(0x2001, 1), (Words{0})) << "the watchdog has not tripped";
}

TEST_F(Ds402Link, SaysDisabledWhileAnEnabledAxisWaitsForItsDemand) {
    Ds402LinkPlant plant{sim};
    plant.open();
    plant.makeActive();
    const auto shows = [&](std::int64_t mode, std::int64_t status) {
        return plant.get<std::int64_t>("/drive/a", "modeDisplay") == mode &&
               plant.get<std::int64_t>("/drive/a", "status") == status;
    };
    const auto setMode = [&](std::int64_t mode) {
        EXPECT_TRUE(plant.call("/processor", "setMode", {{"mode", mode}}).done());
    };
    plant.stepUntil("Ready", [&] { return shows(8, 1); });

    setMode(9);
    plant.stepUntil("Ready by speed", [&] { return shows(9, 1); });
    plant.tree().at("/demand/a").data<double>("position") = 0.5;
    plant.stepWithExchanges(2);
    setMode(8);
    plant.stepUntil("Disabled", [&] { return shows(8, 6); });
    plant.stepWithExchanges(20);
    EXPECT_TRUE(shows(8, 6));
    EXPECT_EQ(plant.driveState(), operationEnabled);
    EXPECT_NEAR(plant.position(), 0, 1e-3);

    plant.tree().at("/demand/a").data<double>("position") = 0.0;
    plant.stepUntil("Ready again", [&] { return shows(8, 1); });
}

TEST_F(Ds402Link, StaysInItsQuickStopUntilADemandThatWasLostRestsAtTheAxis) {
    Ds402LinkPlant plant{sim, alone};
    plant.open();
    Simplex& set = plant.tree().at("/set/a");
    set.data<std::int64_t>("quickStopOption") = 6;  // it stays enabled
    for (const std::int64_t word : {0x06, 0x07, 0x0F}) {
        set.data<std::int64_t>("controlWord") = word;
        plant.stepWithExchanges(3);
    }
    plant.stepUntil("an enabled drive", [&] { return plant.driveState() == operationEnabled; });

    for (const int cycles : {1, 50}) {
        set.data<double>("position") = 0.5;
        set.slot().quality = Quality::Lost;
        plant.step(cycles);
        set.slot().quality = Quality::Good;
        plant.stepWithExchanges(10);
        plant.step();
        EXPECT_NE(plant.driveState(), operationEnabled);
        EXPECT_EQ(plant.get<std::int64_t>("/drive/a", "status"), 6) << "Disabled";
        EXPECT_NEAR(plant.position(), 0, 1e-3);

        set.data<double>("position") = 0.0;
        plant.stepUntil("an enabled drive", [&] { return plant.driveState() == operationEnabled; });
    }
    plant.stepUntil("Ready", [&] { return plant.get<std::int64_t>("/drive/a", "status") == 1; });
}

TEST(SwappedDs402Link, FollowsDemandsInTheOtherOrderOfWords) {
    SimProcess sim{{"--axes", "2", "--absolute", "--low-word-first", "--counts-per-unit",
                    "10430.378", "--rated-effort", "2.5"}};
    Ds402LinkPlant plant{sim,
                         {{{"wordOrder", "LowWordFirst"}},
                          {{"countsPerUnit", "10430.378"}, {"ratedEffort", "2.5"}}}};
    plant.open();
    plant.makeActive();

    plant.moveTo(-0.05);

    EXPECT_NEAR(plant.position(), -0.05, 1e-3);
}

TEST_F(Ds402Link, ComesBackAfterEachKillWithoutRestartingAnything) {
    Ds402LinkPlant plant{sim};
    plant.open();
    for (int i = 1; i <= 3; ++i) {
        plant.makeActive();
        plant.moveTo(0.02);

        sim.kill9();
        const std::int64_t cycles =
            plant.stepUntil("a lost drive", [&] { return plant.quality() == Quality::Lost; });
        EXPECT_LE(cycles, Ds402LinkPlant::lossCycles + 2);
        plant.step(2);
        EXPECT_EQ(plant.state("/processor"), State::Fault);
        EXPECT_EQ(plant.state("/drive"), State::Standby) << "a lost link is no fault";
        EXPECT_NEAR(plant.position(), 0.02, 1e-3) << "the last one that came";
        plant.stepUntil("a refused connection",
                        [&] { return plant.hasTold("nobody listens there"); });

        sim.restart();
        plant.stepUntil("a present answer", [&] { return plant.quality() == Quality::Good; });
        EXPECT_EQ(plant.position(), 0) << "another life of the drive";
        plant.stepUntil("the end of its self test",
                        [&] { return plant.driveState() == switchOnDisabled; });
        plant.stepWithExchanges(20);
        EXPECT_EQ(plant.driveState(), switchOnDisabled) << "nothing moves by itself";
        EXPECT_EQ(plant.position(), 0);
        EXPECT_EQ(plant.count("reconnectCount"), i);
    }
    plant.makeActive();
}

TEST_F(Ds402Link, CountsLateAnswersAndStaysOpen) {
    Ds402LinkPlant plant{sim, alone};
    plant.open();
    for (const std::uint16_t delay : Words{5, 20, 200}) {
        const std::int64_t late = plant.count("lateCount");
        EXPECT_EQ(tool.write(0xF100, {delay, 1}), 0);
        plant.stepUntil("the late answer", [&] { return tool.read(0xF101, 1)[0] == 0; });
        plant.stepWithExchanges(3);
        EXPECT_GT(plant.count("lateCount"), late) << delay;
        EXPECT_GE(plant.get<double>("/drive", "exchangeTimeMax"), 1000 * delay) << "us";
    }
    EXPECT_EQ(plant.count("errorCount"), 0);
    EXPECT_EQ(plant.link(), Link::Open);
}

TEST_F(Ds402Link, ClosesTheLinkOfADriveThatIsTooLateAndOpensItAgain) {
    Ds402LinkPlant plant{sim, {{{"responseTimeout", "0.02"}}, {}, false}};
    plant.open();

    EXPECT_EQ(tool.write(0xF100, {200, 1}), 0);
    plant.stepUntil("a lost drive", [&] { return plant.quality() == Quality::Lost; });
    plant.stepUntil("its reason", [&] { return plant.hasTold("no answer within 20 ms"); });
    plant.stepUntil("a present answer", [&] { return plant.quality() == Quality::Good; });

    EXPECT_GE(plant.count("errorCount"), 1);
    EXPECT_GE(plant.count("reconnectCount"), 1);
}

TEST_F(Ds402Link, NamesEachWrongAnswerAndConnectsAnew) {
    Ds402LinkPlant plant{sim, {{{"responseTimeout", "0.3"}}, {}, false}};
    plant.open();
    const std::pair<std::uint16_t, const char*> ways[] = {{0, "its answer is an old one"},
                                                          {1, "its answer is none to this"},
                                                          {2, "its answer is none to this"},
                                                          {3, "its answer is none to this"},
                                                          {4, "no answer within 300 ms"},
                                                          {5, "its answer is none to this"},
                                                          {6, "(exception 4)"}};
    for (const auto& [way, words] : ways) {
        const std::int64_t errors = plant.count("errorCount");
        const std::size_t told = plant.events().size();
        EXPECT_EQ(tool.write(0xF102, {way, 1}), 0);
        plant.stepUntil("a lost drive", [&] { return plant.count("errorCount") > errors; });
        plant.stepUntil("a present answer", [&] { return plant.quality() == Quality::Good; });
        plant.step();
        EXPECT_NE(plant.events().find(words, told), std::string::npos)
            << way << ": " << plant.events().substr(told);
    }
    EXPECT_GE(plant.count("reconnectCount"), 7);
}

TEST_F(Ds402Link, TellsAFrozenDriveAndOneThatRefusesAndIsBackAfterwards) {
    Ds402LinkPlant plant{sim, {{{"responseTimeout", "0.05"}}, {}, false}};
    plant.open();
    for (const std::uint16_t fault : Words{0xF105, 0xF104}) {
        EXPECT_EQ(tool.write(fault, {1}), 0);
        plant.stepUntil("a lost drive", [&] { return plant.quality() == Quality::Lost; });
        plant.stepUntil("its reason", [&] {
            return plant.hasTold(fault == 0xF105 ? "no answer within" : "nobody listens there");
        });
        EXPECT_NE(plant.link(), Link::Open);
        EXPECT_EQ(tool.write(fault, {0}), 0);
        plant.stepUntil("a present answer", [&] { return plant.quality() == Quality::Good; });
    }
}

TEST_F(Ds402Link, LosesADriveWhoseProcessStandsAndIsBackWhenItGoesOn) {
    Ds402LinkPlant plant{sim, {{{"responseTimeout", "0.05"}}, {}, false}};
    plant.open();

    sim.signal(SIGSTOP);
    plant.stepUntil("a lost drive", [&] { return plant.quality() == Quality::Lost; });
    plant.stepUntil("its reason", [&] { return plant.hasTold("no answer within"); });
    sim.signal(SIGCONT);
    plant.stepUntil("a present answer", [&] { return plant.quality() == Quality::Good; });

    EXPECT_EQ(plant.link(), Link::Open);
}

// What is not the drive that the model has.
struct Wrong {
    std::vector<std::string> options;
    Ds402LinkPlant::Pairs device, observation;
    std::string words;

    friend void PrintTo(const Wrong& wrong, std::ostream* out) { *out << wrong.words; }
};

class RefusedDs402Link : public testing::TestWithParam<Wrong> {};

TEST_P(RefusedDs402Link, SaysInWordsWhatToMakeEqual) {
    const SimProcess sim{GetParam().options};
    Ds402LinkPlant plant{sim, {GetParam().device, GetParam().observation, false}};
    plant.start();

    plant.stepUntil("a refused link", [&] { return plant.hasTold(GetParam().words); });
    plant.stepUntil("it as its link", [&] { return plant.link() == Link::Refused; });

    EXPECT_EQ(plant.quality(), Quality::Lost);
    EXPECT_EQ(BareClient{sim.port()}.read(0x0000, 1), (Words{0})) << "it was not commanded";
}

INSTANTIATE_TEST_SUITE_P(
    Differing, RefusedDs402Link,
    testing::Values(
        Wrong{{}, {}, {}, "it has 1 axes, and 2 are related here; relate as many as it has"},
        Wrong{{"--axes", "2", "--low-word-first"},
              {},
              {},
              "it has the words of its numbers in the other order; set wordOrder accordingly"},
        Wrong{
            {"--axes", "2", "--counts-per-unit", "5000"},
            {},
            {},
            "its axis 1 has 5000 counts per unit, and /drive/a.countsPerUnit is 100000; make them "
            "equal"},
        Wrong{{"--axes", "2"},
              {},
              {{"ratedEffort", "7"}},
              "its axis 1 has a rated effort of 10, and /drive/a.ratedEffort is 7; make them "
              "equal"}));

TEST_F(Ds402Link, IsRefusedWhileAnotherConnectionCommandsTheDrive) {
    EXPECT_EQ(tool.write(0x0000, {0}), 0);
    Ds402LinkPlant plant{sim, alone};
    plant.start();
    plant.stepUntil("its reason", [&] { return plant.hasTold("(exception 4)"); });
    EXPECT_EQ(plant.quality(), Quality::Lost);

    tool.hangUp();
    plant.stepUntil("a present answer", [&] { return plant.quality() == Quality::Good; });
}

TEST_F(Ds402Link, IsNotStartedWithSettingsThatNoDriveTakes) {
    const auto why = [this](const Ds402LinkPlant::Pairs& settings) {
        Ds402LinkPlant plant{sim, {settings, {}, false}};
        try {
            plant.start();
        } catch (const Error& error) {
            return std::string{error.what()};
        }
        return std::string{"nothing"};
    };
    EXPECT_NE(why({{"watchdogTime", "0.001"}})
                  .find("/drive: watchdogTime is 0.001 s, and the "
                        "drive takes 0.01 to 5; write one of them, or "
                        "0 for none"),
              std::string::npos)
        << why({{"watchdogTime", "0.001"}});
    const std::string far = why({{"softLimits", "-1 1e6 0 0"}});
    EXPECT_NE(far.find("/drive, axis 1: the greatest position has more counts than 32 bits hold"),
              std::string::npos)
        << far;
    const std::string slow = why({{"profileVelocity", "0.5 0"}});
    EXPECT_NE(slow.find("/drive, axis 2: The profile velocity (6081) is 0"), std::string::npos)
        << slow;
}

}  // namespace
}  // namespace cortex::modbus::test
