// SPDX-License-Identifier: Apache-2.0
// A coupler of XML alone in a real cortex-agent, which finds the plug-in by itself.
#include "cli/cortex_process.hpp"
#include "modbus/test_servers.hpp"
#include "processes/agent_process.hpp"
#include "support/waiting.hpp"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <modbus/modbus.h>

namespace cortex::modbus::test {
namespace {

using cortex::test::AgentProcess;
using cortex::test::comesTrue;
using cortex::test::contains;
using cortex::test::ModelFolder;

TEST(ModbusAgent, RunsACouplerOfXmlAlone) {
    ModbusServer server;
    const ModelFolder folder;
    const auto system = folder.write(
        "hall.xml",
        "<system name='hall'><morphology file='" CORTEX_SOURCE_DIR
        "/tests/data/modbus-rules.xml'/>"
        "<cluster name='hall' frequency='100'/>"
        "<simplex path='/valves' type='DigitalOutputGroup'><set data='count' value='2'/></simplex>"
        "<simplex path='/levels' type='AnalogueInputGroup'><set data='count' value='4'/></simplex>"
        "<simplex path='/coupler' type='MyCoupler'>"
        "<relate rule='digitalOutputs' to='/valves'/><relate rule='analogueInputs' to='/levels'/>"
        "<set data='address' value='" +
            server.address() +
            "'/><set data='coilsAt' value='8'/><set data='inputRegistersAt' value='16'/>"
            "<set data='responseTimeout' value='0.7'/><set data='lossTime' value='60'/>"
            "</simplex></system>");
    server.look([](modbus_mapping_t& map) { std::fill_n(map.tab_bits, 20, 1); });

    AgentProcess agent{folder, system};

    EXPECT_TRUE(agent.prints("plug-in " CORTEX_BINARY_DIR
                             "/lib/cortex/agent/cortex-modbus.so: loaded for ModbusIoDevice"));
    EXPECT_TRUE(comesTrue("outputs that are off", [&] {
        return server.look([](modbus_mapping_t& map) {
            return map.tab_bits[7] == 1 && map.tab_bits[8] == 0 && map.tab_bits[9] == 0 &&
                   map.tab_bits[10] == 1;
        });
    })) << agent.output();
    EXPECT_EQ(agent.endInOrder(), 0) << agent.output();
    const auto requests = server.requests();
    EXPECT_EQ(hex({requests[0].begin() + 7, requests[0].end()}), "04 00 10 00 04");
    EXPECT_EQ(requests[1][7], 4) << "the first exchange only reads";
    EXPECT_EQ(hex({requests[2].begin() + 7, requests[2].end()}), "0f 00 08 00 02 01 00");
}

// A value that a person set ends with the agent: nobody would stop it later.
TEST(ModbusAgent, LeavesTheSafeValuesOfOutputsThatNobodyWritesAtItsEnd) {
    ModbusServer server;
    const ModelFolder folder;
    const auto system = folder.write(
        "chamber.xml",
        "<system name='chamber'><morphology file='" CORTEX_SOURCE_DIR
        "/tests/data/modbus-rules.xml'/>"
        "<cluster name='chamber' frequency='100'/>"
        "<simplex path='/setpoint' type='SetPoint'><set data='value' value='40'/></simplex>"
        "<simplex path='/lamp' type='Lamp'><set data='value' value='true'/></simplex>"
        "<simplex path='/coupler' type='ModbusIoDevice'>"
        "<relate rule='outputNumbers' to='/setpoint'/><relate rule='outputSignals' to='/lamp'/>"
        "<set data='address' value='" +
            server.address() +
            "'/><set data='coilsAt' value='3'/><set data='holdingRegistersAt' value='7'/>"
            "<set data='responseTimeout' value='0.7'/><set data='lossTime' value='60'/>"
            "</simplex></system>");
    const auto outputs = [&] {
        return server.look([](modbus_mapping_t& map) {
            return std::to_string(map.tab_bits[3]) + " " + std::to_string(map.tab_registers[7]);
        });
    };

    AgentProcess agent{folder, system, {"--startup"}};

    EXPECT_TRUE(comesTrue("what was set", [&] { return outputs() == "1 400"; })) << agent.output();
    EXPECT_EQ(agent.endInOrder(), 0) << agent.output();
    EXPECT_EQ(outputs(), "0 50");
}

// Two starts of whatever name; an output that the plant has on is off in the other one.
class OneCoupler : public testing::Test {
protected:
    std::filesystem::path system(const char* name, const char* lamp) const {
        return folder.write(
            std::string{name} + ".xml",
            "<system name='s'><morphology file='" CORTEX_SOURCE_DIR
            "/tests/data/modbus-rules.xml'/><cluster name='" +
                std::string{name} +
                "' frequency='100'/><simplex path='/lamp' type='Lamp'><set data='value' value='" +
                lamp +
                "'/></simplex><simplex path='/coupler' type='ModbusIoDevice'>"
                "<relate rule='outputSignals' to='/lamp'/><set data='address' value='" +
                server.address() +
                "'/><set data='coilsAt' value='3'/><set data='responseTimeout' value='0.7'/>"
                "<set data='lossTime' value='60'/></simplex></system>");
    }
    bool isOn() {
        return server.look([](modbus_mapping_t& map) { return map.tab_bits[3] == 1; });
    }
    static cortex::test::Outcome run(const std::filesystem::path& system,
                                     std::vector<std::string> options) {
        options.insert(options.begin(), {system.string(), "--offline", "--startup"});
        return cortex::test::runProgram(CORTEX_BINARY_DIR "/bin/cortex-agent", options);
    }

    ModbusServer server;
    const ModelFolder folder;
};

TEST_F(OneCoupler, BelongsToTheProcessThatTalksToIt) {
    AgentProcess plant{folder, system("plant", "true"), {"--startup"}};
    ASSERT_TRUE(plant.prints("devices: /coupler at " + server.address() + ", unit 1\n"));
    ASSERT_TRUE(comesTrue("an output that is on", [&] { return isOn(); })) << plant.output();

    const cortex::test::Outcome other = run(system("other", "false"), {"--seconds", "1"});

    EXPECT_EQ(other.exit, 5) << other.output;
    EXPECT_TRUE(contains(other.errors, "/coupler at " + server.address() + ", unit 1: process " +
                                           std::to_string(plant.pid()) + " (cortex-agent "))
        << other.errors;
    EXPECT_TRUE(contains(other.errors, "--no-devices")) << other.errors;
    EXPECT_TRUE(isOn());
    plant.kill9();
    EXPECT_EQ(run(system("other", "false"), {"--seconds", "1"}).exit, 0) << "nobody has it now";
    EXPECT_FALSE(isOn());
}

TEST_F(OneCoupler, GetsNoOctetFromATrialRun) {
    server.look([](modbus_mapping_t& map) { map.tab_bits[3] = 1; });

    const cortex::test::Outcome trial =
        run(system("trial", "false"), {"--seconds", "1", "--no-devices"});

    EXPECT_EQ(trial.exit, 0) << trial.errors;
    EXPECT_TRUE(contains(trial.output,
                         "no device is talked to, and nothing is kept "
                         "(--no-devices): /coupler at " +
                             server.address()))
        << trial.output;
    EXPECT_TRUE(server.requests().empty());
    EXPECT_TRUE(isOn());
}

}  // namespace
}  // namespace cortex::modbus::test
