// SPDX-License-Identifier: Apache-2.0
// The plant examples/ds402_dual_axis, with the programs that users start.
#include "cli/controlled_agent.hpp"
#include "cli/live_agent.hpp"
#include "modbus/sim_process.hpp"
#include "processes/station.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

constexpr int active = 2, inFault = 4;         // of a state
constexpr int operationEnabled = 5;            // of a drive
constexpr std::uint16_t frictionOfA = 0xF004;  // of the simulator
const Words otherwise = {"--startup", "--priority", "0", "--frequency", "200"};
constexpr std::int64_t lossCycles = 10;  // of lossTime, at that frequency

// One of them, 20 in the soak test: CORTEX_DRIVE_KILLS.
int killsOfTheDrive() {
    const char* text = std::getenv("CORTEX_DRIVE_KILLS");
    return text != nullptr ? std::stoi(text) : 1;
}

struct Ds402DualAxis : testing::Test {
    Ds402DualAxis() { EXPECT_TRUE(becomesReady()); }

    static json valueOf(const std::string& path, const std::string& item) {
        const json shown = json::parse(live({"show", path, "--json"}).output, nullptr, false);
        return shown.contains("data") ? shown["data"][item]["value"] : json{};
    }
    static bool call(const Words& words) { return live(Words{"call"} + words).exit == 0; }
    static double position(const std::string& axis) {
        const json value = valueOf("/drive/" + axis, "position");
        return value.is_number() ? value.get<double>() : NAN;
    }
    // Faults cleared, started, homed: again, where the loop stood still on the way.
    static bool becomesReady() {
        return becomesTrue([] {
            const json state = valueOf("/processor", "state");
            if (state == inFault) call({"/processor", "clearFaults"});
            if (state != active) call({"/processor", "startup"});
            return call({"/processor", "home"}) && valueOf("/drive/a", "homed") == true &&
                   valueOf("/processor", "state") == active;
        });
    }
    static void aim(double to) {
        live({"set", "/a/pose", "pose=" + std::to_string(to) + " 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0"});
    }
    // Axis A goes there while B is jogged.
    static bool bothMove(double to) {
        const std::string program = CORTEX_BINARY_DIR "/bin/cortex call ";
        const std::string script =
            program + "/a/pose moveTo speedShare=1 --timeout 20 & for i in 1 2 3 4 5; do " +
            program + "/b/jog jog velocity=0.5; done; wait $!";
        return becomesTrue([&] {
            if (valueOf("/processor", "state") != active) becomesReady();
            call({"/b", "select", "group=2"});
            aim(to);
            runProgram("sh", {"-c", script},
                       {{"CORTEX_DOMAIN", domain}, {"CORTEX_INTERFACE", "lo"}});
            return std::abs(position("a") - to) < 0.001;
        });
    }

    // In cycles of the agent, from the last answer to the loss and from that to the fault.
    void expectLossInTime(Station& station) {
        ASSERT_TRUE(station.waitFor([&] {
            return station.hasEvent("/drive", "the device is lost") && faultIn(station) &&
                   station.number("/processor", "state") == inFault;
        }));
        const auto lost = station.event("/drive", "the device is lost");
        const auto fault = faultIn(station);
        lostAfter.push_back(lost->cycle - station.stampOf("/drive/a"));
        EXPECT_LE(lostAfter.back(), lossCycles + 2) << lost->text;
        EXPECT_LE(fault->cycle - lost->cycle, 1) << fault->text;
        EXPECT_GE(fault->cycle, lost->cycle);
    }
    static std::optional<AgentEvent> faultIn(const Station& station) {
        for (AgentEvent& each : station.events())
            if (each.path == "/processor" && each.kind == "fault") return std::move(each);
        return std::nullopt;
    }

    std::vector<std::int64_t> lostAfter;  // cycles
    modbus::test::SimProcess sim{{"--axes", "2"}};
    Background agent{
        agentCommand(CORTEX_SOURCE_DIR "/examples/ds402_dual_axis/ds402_dual_axis.xml") +
        otherwise +
        Words{"--set", "/drive.address=" + sim.address(), "--set", "/drive.watchdogTime=1"}};
};

TEST_F(Ds402DualAxis, MovesOneAxisWhileTheOtherIsJogged) {
    EXPECT_EQ(valueOf("/drive/b", "driveState"), operationEnabled);

    EXPECT_TRUE(bothMove(1)) << position("a");

    EXPECT_GT(position("b"), 0.05);
}

TEST_F(Ds402DualAxis, NamesAFollowingErrorOfTheDriveAndGoesOnWhenItsCauseIsGone) {
    modbus::test::BareClient tool{sim.port()};
    EXPECT_EQ(tool.write(frictionOfA, {0, 40000}), 0);  // N.m / 1000: more than the motor has

    EXPECT_TRUE(becomesTrue([] {
        if (valueOf("/processor", "state") != active) becomesReady();
        aim(1);
        call({"/a/pose", "moveTo"});
        return valueOf("/drive/a", "errorCode") == 0x8611;
    })) << valueOf("/drive/a", "errorCode");
    EXPECT_TRUE(becomesTrue([] { return valueOf("/processor", "state") == inFault; }));

    EXPECT_EQ(tool.write(frictionOfA, {0, 0}), 0);
    EXPECT_TRUE(becomesReady());
    EXPECT_TRUE(bothMove(0.2)) << position("a");
}

TEST_F(Ds402DualAxis, GoesOnWithAnotherLifeOfItsDriveWithoutAStartOfTheAgent) {
    Station station;
    for (int kill = 1; kill <= killsOfTheDrive() && !HasFailure(); ++kill) {
        SCOPED_TRACE("kill " + std::to_string(kill));
        ASSERT_TRUE(station.waitFor([&] { return station.stampOf("/drive/a") > 0; }));
        station.mark();
        sim.kill9();
        EXPECT_TRUE(becomesTrue([] { return valueOf("/processor", "state") == inFault; }));
        expectLossInTime(station);

        sim.restart();
        EXPECT_TRUE(becomesTrue([] { return valueOf("/drive", "link") == 2; }));
        EXPECT_NE(valueOf("/drive/a", "driveState"), operationEnabled)
            << "nothing starts by itself";

        EXPECT_TRUE(becomesReady());
        EXPECT_TRUE(bothMove(kill % 2 == 0 ? 0.1 : 0.2)) << position("a");
        EXPECT_TRUE(agent.runs());
    }
    std::cout << "drive killed " << lostAfter.size() << " times, lost at most "
              << std::ranges::max(lostAfter) << " cycles after its last answer" << std::endl;
}

}  // namespace
}  // namespace cortex::test
