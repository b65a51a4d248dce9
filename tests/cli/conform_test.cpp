// SPDX-License-Identifier: Apache-2.0
// `cortex conform` on devices that keep their promises, and on such as break one.
#include "cli/conform_plant.hpp"
#include "cli/controlled_agent.hpp"
#include "cli/live_agent.hpp"
#include "cli/on_terminal.hpp"

#include <algorithm>
#include <csignal>
#include <set>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

json conform(const Words& arguments, int exit) {
    json all = liveJson(Words{"conform"} + arguments, "conform", exit);
    return all.contains("devices") ? all : json{{"devices", json::array()}, {"failed", 0}};
}

// "passed: by /arm/move", of one test of one device; "": it has no such test.
std::string saidOf(const json& all, const std::string& path, const std::string& test) {
    for (const json& device : all["devices"]) {
        if (device["path"] != path) continue;
        for (const json& each : device["results"]) {
            if (each["test"] == test)
                return each["verdict"].get<std::string>() + ": " + each["text"].get<std::string>();
        }
    }
    return {};
}

std::set<std::string> failedOf(const json& all, const std::string& path) {
    std::set<std::string> failed;
    for (const json& device : all["devices"]) {
        if (device["path"] != path) continue;
        for (const json& each : device["results"]) {
            if (each["verdict"] == "failed") failed.insert(each["test"]);
        }
    }
    return failed;
}

// The one test that finds the mistake of a device, and words of what it says.
struct Found {
    std::string path, test;
    Words words;
};

void expectFound(const json& all, const std::vector<Found>& table) {
    for (const Found& each : table) {
        const std::string said = saidOf(all, each.path, each.test);
        EXPECT_TRUE(said.starts_with("failed: ")) << each.path << ": " << said;
        for (const std::string& word : each.words) {
            EXPECT_TRUE(contains(said, word)) << each.path << " lacks '" << word << "': " << said;
        }
    }
}

TEST(CortexConform, PassesDevicesThatKeepTheirPromisesAndLeavesThemAsTheyWere) {
    ConformPlant plant;
    plant.addAxis("/arm", "SimulatedAxis");
    plant.addAxis("/joint", "ScriptedAxis", "0", "JogController");
    plant.addBus("/bus", "0");
    plant.start();
    const ModelFolder folder;
    const std::string file = (folder.path() / "results.xml").string();
    const Value pose = plant.value("/arm/move", "pose");

    const json all = conform({"/arm", "/joint", "/bus", "--move", "0.2", "--speed", "1",
                              "--seconds", "1", "--junit", file},
                             0);

    EXPECT_EQ(all["failed"], 0) << all.dump(1);
    EXPECT_EQ(saidOf(all, "/arm", "it moves on command"), "passed: by /arm/move");
    EXPECT_EQ(saidOf(all, "/joint", "it moves on command"), "passed: by /joint/move");
    for (const char* each : {"it starts where it is", "it arrives", "it stops without a demand",
                             "it is braked in Standby", "states are reached"}) {
        EXPECT_TRUE(saidOf(all, "/arm", each).starts_with("passed")) << saidOf(all, "/arm", each);
        EXPECT_TRUE(saidOf(all, "/joint", each).starts_with("passed"))
            << saidOf(all, "/joint", each);
    }
    for (const char* each : {"exchanges are counted", "reconnect() opens it again", "age is honest",
                             "stamps are honest", "counters never fall"}) {
        EXPECT_TRUE(saidOf(all, "/bus", each).starts_with("passed")) << saidOf(all, "/bus", each);
    }
    for (const char* each : {"/arm", "/joint", "/bus", "/arm/move", "/joint/move"}) {
        EXPECT_EQ(plant.state(each), State::Standby) << each;
    }
    EXPECT_EQ(plant.value("/arm/move", "pose"), pose);
    EXPECT_EQ(plant.integer("/joint/move", "mode"), 2) << "Velocity, as before";
    const std::string written = folder.read("results.xml");
    EXPECT_TRUE(contains(written, "<testsuite name=\"/bus\"")) << written;
    EXPECT_TRUE(contains(written, "failures=\"0\"")) << written;
    EXPECT_TRUE(contains(written, "<skipped message=\"it is not in Fault")) << written;
}

TEST(CortexConform, MovesNothingUnlessItIsToldHowFar) {
    ConformPlant plant;
    plant.addAxis("/arm", "SimulatedAxis");
    plant.start();

    const json all = conform({"/arm"}, 0);

    std::size_t moving = 0;
    for (const json& device : all["devices"]) {
        for (const json& each : device["results"]) {
            if (!each["moves"]) continue;
            ++moving;
            EXPECT_EQ(each["verdict"], "skipped") << each;
            EXPECT_TRUE(contains(each["text"], "--move AMPLITUDE allows that, in rad")) << each;
        }
    }
    EXPECT_EQ(moving, 10U);
    EXPECT_EQ(saidOf(all, "/arm", "states are reached"),
              "skipped: its startup may move it or give it power; --move AMPLITUDE allows that");
    EXPECT_EQ(plant.number("/arm/is", "position"), 0);
}

TEST(CortexConform, LeavesADeviceThatIsActiveAsItIs) {
    ConformPlant plant;
    plant.addAxis("/arm", "SimulatedAxis");
    plant.start();
    ASSERT_EQ(live({"call", "/bench", "startup", "prefix=/"}).exit, 0);

    const json still = conform({"/arm"}, 0);
    const json moved = conform({"/arm", "--move", "0.2", "--speed", "1"}, 0);

    EXPECT_TRUE(contains(saidOf(moved, "/arm", "states are reached"),
                         "skipped: it is Active, and somebody may need it"));
    EXPECT_TRUE(contains(saidOf(still, "/arm", "states are reached"), "may move it"));
    EXPECT_TRUE(saidOf(moved, "/arm", "it arrives").starts_with("passed")) << moved.dump(1);
    EXPECT_EQ(plant.state("/arm"), State::Active);
    EXPECT_EQ(plant.state("/arm/move"), State::Active);
}

TEST(CortexConform, FindsWhatADeviceBehindABusBreaks) {
    ConformPlant plant;
    const std::vector<std::string> mistakes{"/age",    "/jump",   "/fall", "/fresh",
                                            "/future", "/misses", "/twice"};
    for (std::size_t i = 0; i < mistakes.size(); ++i) {
        plant.addBus(mistakes[i], std::to_string(i + 1));
    }
    plant.addBus("/shut", "9");
    plant.add("/unstated", "UnstatedDevice", {{"observations", "/seen"}});
    plant.add("/seen", "DigitalIoConcept");
    plant.start();

    EXPECT_EQ(live({"call", "/unstated", "startup"}).exit, 1) << "it faults";
    ASSERT_TRUE(becomesTrue([&] { return plant.state("/unstated") == State::Fault; }));

    const json all = conform(mistakes + Words{"/shut", "/unstated", "--seconds", "1.2"}, 1);

    expectFound(
        all,
        {{"/age", "age is honest", {"age fell from", "the link was not Open", "another answer"}},
         {"/jump", "exchanges are counted", {"exchangeCount grew by", "were due", "twice?"}},
         {"/fall", "counters never fall", {"exchangeCount fell from"}},
         {"/fresh", "stamps are honest", {"/fresh/is got a newer stamp", "an old value"}},
         {"/shut", "stamps are honest", {"while exchangeCount grew to", "where link is written"}},
         {"/future", "stamps are honest", {"younger than the cycle", "setQuality()"}},
         {"/misses", "exchanges are counted", {"neither as late nor as errors"}},
         {"/twice", "reconnect() opens it again", {"reconnectCount grew by 2", "Open and 1"}},
         {"/unstated",
          "loss of its controller is stated",
          {"onControllerLoss is 0 (Unknown)", "<data name=\"onControllerLoss\" default=\"2\"/>"}},
         {"/unstated",
          "types and rules are complete",
          {"item silent of UnstatedDevice has no description"}},
         {"/unstated", "states are reached", {"is in Fault (no power) after startup", "events"}},
         {"/unstated", "observations are good", {"/seen is lost", "2 s"}}});
    EXPECT_EQ(saidOf(all, "/unstated", "a fault clears"),
              "passed: it was in Fault (no power) and is now in Standby");
    EXPECT_EQ(plant.state("/unstated"), State::Standby) << "and again after the test of states";
    EXPECT_EQ(failedOf(all, "/age"), std::set<std::string>{"age is honest"});
    EXPECT_EQ(failedOf(all, "/fresh"), std::set<std::string>{"stamps are honest"});
    EXPECT_EQ(failedOf(all, "/misses"), std::set<std::string>{"exchanges are counted"});
}

TEST(CortexConform, FindsWhatAnAxisBreaks) {
    ConformPlant plant;
    const std::vector<std::string> mistakes{"/sign", "/range", "/degrees",
                                            "/runs", "/brake", "/silent"};
    for (std::size_t i = 0; i < mistakes.size(); ++i) {
        plant.addAxis(mistakes[i], "ScriptedAxis", std::to_string(i + 1));
    }
    plant.start();

    const json all = conform(mistakes + Words{"--move", "0.4", "--speed", "1"}, 1);

    expectFound(all, {{"/sign", "sign is right", {"went -0.4 rad where 0.4 rad", "the sign of"}},
                      {"/range", "limits are kept", {"was at 0.51 rad", "outside of -0.5 rad"}},
                      {"/degrees", "it moves on command", {"more than twice the amplitude"}},
                      {"/runs", "it stops without a demand", {"still moves 2 s after /runs/move"}},
                      {"/brake", "it is braked in Standby", {"is Ready", "Braked or Disabled"}},
                      {"/silent",
                       "velocity is that of its position",
                       {"/silent/is went 0.", "its velocity adds up to 0 rad"}}});
    EXPECT_EQ(failedOf(all, "/silent"), std::set<std::string>{"velocity is that of its position"});
    EXPECT_EQ(failedOf(all, "/range"), std::set<std::string>{"limits are kept"});
    EXPECT_EQ(failedOf(all, "/brake"), std::set<std::string>{"it is braked in Standby"});
    for (const std::string& each : mistakes) {
        EXPECT_EQ(plant.state(each), State::Standby) << each;
        EXPECT_EQ(plant.state(each + "/move"), State::Standby) << each;
    }
}

TEST(CortexConform, SaysWhyAnAxisCannotBeMoved) {
    ConformPlant plant;
    plant.addAxis("/alone", "SimulatedAxis", "", "");
    plant.addAxis("/held", "SimulatedAxis", "", "HoldAxisController");
    plant.addAxis("/near", "SimulatedAxis");
    plant.start();
    ASSERT_EQ(live({"call", "/held/move", "startup"}).exit, 0);

    const json all = conform({"/alone", "/held", "/near", "--move", "0.6"}, 1);

    const std::string test = "it moves on command";
    EXPECT_TRUE(contains(
        saidOf(all, "/alone", test),
        "skipped: no AxisPoseController, JogController or GripperController of agent bench writes "
        "/alone/wish"));
    EXPECT_TRUE(
        contains(saidOf(all, "/held", test), "/held/move writes /held/wish and is in Active"));
    EXPECT_TRUE(contains(saidOf(all, "/near", test), "0.6 is outside of the range -0.5 to 0.5"));
    EXPECT_EQ(plant.state("/held/move"), State::Active);
}

TEST(CortexConform, LeadsADriveThroughItsTransitions) {
    ConformPlant plant;
    plant.addDrive("/drive", "Ds402SimulatedDrive");
    plant.addDrive("/blind", "Ds402SimulatedDrive", true);
    plant.start();

    const json unhomed = conform({"/blind", "--move", "0.2", "--seconds", "0.2"}, 0);
    const json all =
        conform({"/drive", "/blind", "--move", "0.2", "--home", "--seconds", "0.2"}, 0);

    for (const char* each :
         {"mode is echoed", "transition 2", "transition 3", "transition 4", "transition 5",
          "transition 6", "transition 7", "transition 8", "transition 9", "transition 10",
          "transition 11", "transition 12", "transition 16", "words refused: Switch on disabled",
          "words refused: Operation enabled", "it arrives", "velocity is that of its position",
          "acceleration changes"}) {
        EXPECT_TRUE(saidOf(all, "/drive", each).starts_with("passed"))
            << each << ": " << saidOf(all, "/drive", each);
    }
    EXPECT_EQ(plant.value("/drive/lead", "quickStopOption"),
              Value{std::vector<std::int64_t>({2, 2})})
        << "as before transition 16";
    EXPECT_TRUE(contains(saidOf(all, "/drive", "homing finds its zero"), "homingNeeded"));
    EXPECT_TRUE(contains(saidOf(unhomed, "/blind", "homing finds its zero"), "--home allows that"));
    EXPECT_TRUE(
        contains(saidOf(unhomed, "/blind", "it arrives"), "/blind/is is not homed; --home"));
    EXPECT_TRUE(saidOf(all, "/blind", "homing finds its zero").starts_with("passed"));
    EXPECT_TRUE(saidOf(all, "/blind", "it arrives").starts_with("passed"));
    EXPECT_TRUE(contains(saidOf(all, "/drive", "its watchdog trips"), "not built"));
    for (const char* each : {"/drive", "/drive/lead", "/drive/move"}) {
        EXPECT_EQ(plant.state(each), State::Standby) << each;
    }
    EXPECT_EQ(plant.integer("/drive/is", "driveState"), 2) << "Switch on disabled, as before";
    EXPECT_EQ(plant.integer("/drive/set", "mode"), 8);
}

TEST(CortexConform, FindsADriveThatDoesNotHear) {
    ConformPlant plant;
    plant.addDrive("/mute", "MuteDrive");
    plant.start();

    const json all = conform({"/mute", "--seconds", "0.5"}, 1);

    expectFound(all,
                {{"/mute", "mode is echoed", {"CyclicPosition was wished", "is None", "6061h"}},
                 {"/mute",
                  "transition 2",
                  {"Shutdown in SwitchOnDisabled led to SwitchOnDisabled",
                   "ReadyToSwitchOn was expected"}}});
    EXPECT_TRUE(saidOf(all, "/mute", "words refused: Switch on disabled").starts_with("passed"));
}

// A gripper of a bare axis: nothing between its jaws, and then a work piece of 30 mm.
TEST(CortexConform, OpensClosesAndGripsWhatIsBetweenTheJaws) {
    ConformPlant plant;
    plant.addGripper("/jaws");
    plant.start();

    const json still = conform({"/jaws", "--seconds", "0.2"}, 0);
    const json nothing = conform({"/jaws", "--move", "0.01", "--grip", "0", "--seconds", "0.2"}, 0);
    const json missing = conform({"/jaws", "--grip", "0.03", "--seconds", "0.2"}, 1);
    plant.setStops("/jaws", 0.03, 0.1);
    const json piece = conform({"/jaws", "--grip", "0.03", "--seconds", "0.2"}, 0);
    const json unsaid = conform({"/jaws", "--grip", "0", "--seconds", "0.2"}, 1);

    EXPECT_TRUE(contains(saidOf(still, "/jaws", "grips"), "--grip WIDTH allows that"));
    EXPECT_EQ(saidOf(nothing, "/jaws", "it moves on command"), "passed: by /jaws/move");
    EXPECT_EQ(saidOf(nothing, "/jaws", "opens and closes"), "passed: 0 mm to 100 mm");
    EXPECT_EQ(saidOf(nothing, "/jaws", "grips"), "passed: nothing is there, and it says so");
    expectFound(missing, {{"/jaws", "opens and closes", {"30 mm was expected"}},
                          {"/jaws", "grips", {"grip ended with"}}});
    EXPECT_TRUE(saidOf(piece, "/jaws", "opens and closes").starts_with("passed: 30 mm to 100"));
    EXPECT_TRUE(saidOf(piece, "/jaws", "grips").starts_with("passed: holds 30"))
        << saidOf(piece, "/jaws", "grips");
    expectFound(unsaid, {{"/jaws", "opens and closes", {"is something between the jaws?"}},
                         {"/jaws", "grips", {"--grip WIDTH says what is"}}});
    for (const char* each : {"/jaws", "/jaws/lead", "/jaws/move"}) {
        EXPECT_EQ(plant.state(each), State::Standby) << each;
    }
}

// An interrupt on the way of a slow motion. The plant is no faster than time, so that the motion
// lasts until the interrupt comes.
TEST(CortexConform, PutsEverythingBackWhereItIsInterrupted) {
    ConformPlant plant;
    plant.addAxis("/arm", "SimulatedAxis");
    plant.start(std::chrono::milliseconds{10});
    const Value pose = plant.value("/arm/move", "pose");
    OnTerminal run{cortexCommand({"conform", "/arm", "--move", "0.4", "--speed", "0.05"})};
    const bool moves = becomesTrue([&] { return plant.number("/arm/is", "position") > 0.05; });

    run.signal(SIGINT);

    ASSERT_TRUE(moves) << run.exit() << ": " << run.output();

    EXPECT_EQ(run.exit(), -SIGINT) << run.output();
    EXPECT_EQ(plant.state("/arm"), State::Standby) << run.output();
    EXPECT_EQ(plant.state("/arm/move"), State::Standby);
    EXPECT_EQ(plant.value("/arm/move", "pose"), pose);
    EXPECT_LT(plant.number("/arm/is", "position"), 0.4);
}

TEST_F(CortexControl, ConformSaysThatItNeedsControlAndTakesIt) {
    const json without = conform({"/drive", "--move", "0.1"}, 1);
    const std::string said = saidOf(without, "/drive", "states are reached");
    EXPECT_TRUE(contains(said, "skipped: startup of /drive was not allowed: control is required"))
        << said;
    EXPECT_TRUE(contains(said, "--take takes control")) << said;

    const json with = conform({"/drive", "--move", "0.1", "--take"}, 1);

    EXPECT_TRUE(saidOf(with, "/drive", "states are reached").starts_with("passed")) << with.dump(1);
    EXPECT_TRUE(leases().empty()) << leases();
}

TEST(CortexConform, RefusesWhatCannotBeTested) {
    ConformPlant plant;
    plant.addAxis("/arm", "SimulatedAxis");
    plant.start();
    const ModelFolder folder;
    const std::string file = folder.write("plant.xml", "<system/>").string();

    const Outcome noDevice = live({"conform", "/arm/move"});
    const Outcome exists = live({"conform", "/arm", "--junit", file});
    const Outcome nowhere = live({"conform", "/arm", "--junit", file + ".d/results.xml"});

    EXPECT_EQ(noDevice.exit, 3);
    EXPECT_TRUE(contains(noDevice.errors,
                         "/arm/move (AxisPoseController) is no Device; agent bench has /arm"))
        << noDevice.errors;
    EXPECT_EQ(exists.exit, 1);
    EXPECT_TRUE(contains(exists.errors, "exists; give another name, or --force")) << exists.errors;
    EXPECT_EQ(folder.read("plant.xml"), "<system/>");
    EXPECT_EQ(nowhere.exit, 3);
    EXPECT_TRUE(contains(nowhere.errors, "there is no folder")) << nowhere.errors;
    EXPECT_EQ(nowhere.output, "") << "before anything is tested";
    for (const char* each : {"nan", "-1", "0.1rad"}) {
        EXPECT_EQ(live({"conform", "/arm", "--move", each}).exit, 2) << each;
    }
}

}  // namespace
}  // namespace cortex::test
