// SPDX-License-Identifier: Apache-2.0
// A coupler whose places are single concepts of a plant's own types, which a person sets and the
// ready-made controllers read and write; against a server of libmodbus. The loop is stepped.
#include "cortex/core/error.hpp"
#include "cortex/cs/testing.hpp"
#include "cortex/toolkit/classes.hpp"
#include "cortex/toolkit/fieldbus_link.hpp"

#include "modbus/test_servers.hpp"
#include "modbus_io_device.hpp"
#include "support/waiting.hpp"

#include <cmath>
#include <cstdint>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <modbus/modbus.h>

namespace cortex::modbus::test {
namespace {

using namespace std::chrono_literals;
using Texts = cs::TestPlant::Pairs;

// A climate chamber: a temperature and an alarm come in, a set-point, a heater and a lamp go out.
class ChamberPlant : public cs::TestPlant {
public:
    explicit ChamberPlant(const std::string& address = "127.0.0.1:1", const Texts& relates = {},
                          const Texts& settings = {})
        : TestPlant{{CORTEX_SOURCE_DIR "/tests/data/modbus-rules.xml"}, 1s} {
        classes().add<ModbusIoDevice>("ModbusIoDevice");
        toolkit::addClasses(classes());
        add("/temperature", "ChamberTemperature");
        add("/alarm", "DigitalInput");
        add("/setpoint", "SetPoint");
        add("/heating", "Heating");
        add("/lamp", "Lamp");
        Texts allRelates{{"inputNumbers", "/temperature"},
                         {"inputSignals", "/alarm"},
                         {"outputNumbers", "/setpoint"},
                         {"outputNumbers", "/heating"},
                         {"outputSignals", "/lamp"}};
        allRelates.insert(allRelates.end(), relates.begin(), relates.end());
        Texts allSettings{
            {"address", address},       {"exchangePeriod", "0.001"}, {"responseTimeout", "0.7"},
            {"lossTime", "40"},         {"reconnectTime", "0.01"},   {"coilsAt", "10"},
            {"discreteInputsAt", "20"}, {"inputRegistersAt", "30"},  {"holdingRegistersAt", "40"}};
        allSettings.insert(allSettings.end(), settings.begin(), settings.end());
        add("/coupler", "ModbusIoDevice", allRelates, allSettings);
    }
    void send(const std::string& path, const std::string& command, double target) {
        cluster().send(path, command, {{"target", target}});
    }
    Quality quality(const std::string& path) {
        const Image image = cluster().image();
        return image.state(image.structure().find(path)).quality;
    }
};

class ModbusIoOfSingles : public testing::Test {
protected:
    // Each step sees an answer that is new, so that no measurement is older than a controller
    // allows.
    void stepUntil(ChamberPlant& plant, const std::string& what,
                   const std::function<bool()>& condition) {
        cortex::test::waitUntil(what, [&] {
            if (condition()) return true;
            server.waitForRequests(8);
            plant.step();
            return false;
        });
    }
    void measure(std::uint16_t counts, bool alarm) {
        server.look([&](modbus_mapping_t& map) {
            map.tab_input_registers[30] = counts;
            map.tab_input_bits[20] = alarm ? 1 : 0;
        });
    }
    // The lamp, then the registers of set-point and heater.
    std::string outputs() {
        return server.look([](modbus_mapping_t& map) {
            return std::to_string(map.tab_bits[10]) + " " + std::to_string(map.tab_registers[40]) +
                   " " + std::to_string(map.tab_registers[41]);
        });
    }
    void expectOutputs(ChamberPlant& plant, const std::string& wanted) {
        stepUntil(plant, "outputs " + wanted, [&] { return outputs() == wanted; });
        EXPECT_EQ(outputs(), wanted);
    }

    ModbusServer server;
};

TEST_F(ModbusIoOfSingles, IsMeasuredByItsConceptsAndSetByAPerson) {
    measure(455, true);
    ChamberPlant plant{server.address()};
    plant.start();
    stepUntil(plant, "a measurement", [&] { return plant.quality("/alarm") == Quality::Good; });
    EXPECT_EQ(plant.get<double>("/temperature", "value"), -20 + 0.1 * 455);
    EXPECT_TRUE(plant.get<bool>("/alarm", "value"));
    expectOutputs(plant, "0 50 0");

    plant.startUp();
    expectOutputs(plant, "0 200 0");
    EXPECT_TRUE(plant.call("/setpoint", "set", {{"value", 62.5}}).done());
    EXPECT_TRUE(plant.call("/lamp", "set", {{"value", true}}).done());
    expectOutputs(plant, "1 625 0");
    EXPECT_FALSE(plant.call("/setpoint", "set", {{"value", 100.0}}).done()) << "90 is its limit";
    measure(0, false);
    stepUntil(plant, "another measurement",
              [&] { return plant.get<double>("/temperature", "value") == -20; });
    EXPECT_FALSE(plant.get<bool>("/alarm", "value"));
    EXPECT_EQ(outputs(), "1 625 0");
}

TEST_F(ModbusIoOfSingles, IsMeasuredAndHeatedByAPidController) {
    measure(400, false);  // 20 Cel
    ChamberPlant plant{server.address()};
    plant.add("/pid", "PidController",
              {{"measured", "/temperature"}, {"setpoint", "/setpoint"}, {"output", "/heating"}},
              {{"kp", "2"}});
    plant.start();
    stepUntil(plant, "a measurement",
              [&] { return plant.quality("/temperature") == Quality::Good; });
    plant.cluster().send("/coupler", "startup");
    plant.cluster().send("/pid", "startup");
    stepUntil(plant, "a controller", [&] { return plant.state("/pid") == State::Active; });

    measure(300, false);  // 10 Cel below: twice that, in units of 0.01 %
    expectOutputs(plant, "0 200 2000");
    measure(375, false);
    expectOutputs(plant, "0 200 500");
}

TEST_F(ModbusIoOfSingles, GivesWhatAControllerWritesInEachOfItsStates) {
    ChamberPlant plant{server.address()};
    plant.add("/ramp", "Ramp", {{"result", "/heating"}}, {{"rate", "1000"}});
    plant.start();
    EXPECT_TRUE(plant.call("/ramp", "startup").done());
    plant.send("/ramp", "goTo", 50);
    expectOutputs(plant, "0 50 5000");
    EXPECT_EQ(plant.state("/coupler"), State::Standby);

    EXPECT_TRUE(plant.call("/coupler", "startup").done());
    expectOutputs(plant, "0 200 5000");
    EXPECT_TRUE(plant.call("/coupler", "shutdown").done());
    expectOutputs(plant, "0 50 5000");
    EXPECT_TRUE(plant.call("/ramp", "shutdown").done());
    expectOutputs(plant, "0 50 0");
}

TEST_F(ModbusIoOfSingles, GetsNoStepOfARampThatWouldHaveGoneOnWhileItWasAway) {
    constexpr int perCycle = 300;  // 3 % in a cycle of 1 s, in units of 0.01 %
    ChamberPlant plant{server.address()};
    plant.add("/ramp", "Ramp", {{"result", "/heating"}}, {{"rate", "3"}});
    plant.start();
    EXPECT_TRUE(plant.call("/ramp", "startup").done());
    plant.send("/ramp", "goTo", 90);
    const auto heater = [&] {
        return server.look([](modbus_mapping_t& map) { return int{map.tab_registers[41]}; });
    };
    stepUntil(plant, "a heater that is on", [&] { return heater() > 2 * perCycle; });
    const auto open = static_cast<std::int64_t>(toolkit::Link::Open);
    const auto isOpen = [&] { return plant.get<std::int64_t>("/coupler", "link") == open; };
    server.leave();
    cortex::test::waitUntil("a link that is closed", [&] {
        if (!isOpen()) return true;
        std::this_thread::sleep_for(1ms);
        plant.step();
        return false;
    });
    plant.step(2);
    const double stood = plant.get<double>("/heating", "value");
    plant.step(20);
    EXPECT_EQ(plant.get<double>("/heating", "value"), stood) << "20 cycles would be 60 %";

    server.comeBack();
    server.waitForRequests(8);  // its thread connects without a cycle
    int before = heater();
    EXPECT_EQ(before, std::lround(stood * 100));
    stepUntil(plant, "the target", [&] {
        EXPECT_LE(heater() - before, 2 * perCycle) << "it may see two cycles at once";
        before = heater();
        return before == 9000;
    });
}

// Its own silence makes no demand older that follows from what it measured.
TEST_F(ModbusIoOfSingles, KeepsItsOutputsWhileItIsAwayAndWhenItIsBack) {
    measure(455, false);  // 25.5 Cel
    ChamberPlant plant{server.address()};
    plant.add("/filter", "HoldingFilter", {{"source", "/temperature"}, {"result", "/setpoint"}},
              {{"timeConstant", "0"}});
    plant.start();
    stepUntil(plant, "a measurement",
              [&] { return plant.quality("/temperature") == Quality::Good; });
    EXPECT_TRUE(plant.call("/filter", "startup").done());
    expectOutputs(plant, "0 255 0");
    const std::size_t before = server.requests().size();
    for (const int cycles : {20, 300}) {  // of 1 s; the demand may be 3 s old, an answer 40 s
        const auto reconnects = plant.get<std::int64_t>("/coupler", "reconnectCount");
        server.leave();
        plant.step(cycles);
        server.comeBack();
        stepUntil(plant, "a coupler that is back", [&] {
            return plant.get<std::int64_t>("/coupler", "reconnectCount") > reconnects &&
                   plant.quality("/temperature") == Quality::Good;
        });
        for (int cycle = 0; cycle < 20; ++cycle) {
            server.waitForRequests(8);
            plant.step();
        }
    }
    const std::vector<Bytes> all = server.requests();
    int writes = 0;
    for (std::size_t i = before; i < all.size(); ++i) {
        if (all[i].size() < 15 || all[i][7] != 16) continue;
        EXPECT_EQ(all[i][13] * 256 + all[i][14], 255) << "5 Cel would be safe";
        ++writes;
    }
    EXPECT_GT(writes, 40);
}

std::string chamberRefusal(const std::string& type, const Texts& relates, const Texts& settings) {
    ChamberPlant plant{"127.0.0.1:1", relates};
    if (!type.empty()) plant.add("/more", type, {}, settings);
    try {
        plant.start();
        return "";
    } catch (const std::exception& error) {
        return error.what();
    }
}

TEST(ModbusIoOfSinglesModel, ThatCannotStandIsRefusedInWords) {
    struct Case {
        std::string type;
        std::string rule;
        Texts settings;
        std::string words;
    };
    const std::vector<Case> cases{
        {"Heating", "outputNumbers", {{"scale", "0.1"}}, ""},
        {"Heating", "outputNumbers", {{"scale", "0"}}, "/more (Heating) has the scale 0, and no"},
        {"ChamberTemperature",
         "inputNumbers",
         {{"scale", "0"}},
         "/more (ChamberTemperature) has the scale 0, and no"},
        {"HeldHeating", "outputNumbers", {}, "/more (HeldHeating) has no safe value"},
        {"SetPoint",
         "outputNumbers",
         {{"scale", "0.0001"}},
         "/more (SetPoint) has the safe value 5, which the register cannot hold"},
        {"AnalogueOutputGroup",
         "analogueOutputs",
         {},
         "/coupler: a group is related by rule analogueOutputs, and single concepts by "
         "outputNumbers, but both begin at the same address; remove one of the two"},
        {"DigitalInputGroup",
         "digitalInputs",
         {},
         "a group is related by rule digitalInputs, and single concepts by inputSignals"},
    };
    for (const Case& each : cases) {
        const std::string text = chamberRefusal(each.type, {{each.rule, "/more"}}, each.settings);
        if (each.words.empty())
            EXPECT_EQ(text, "");
        else
            EXPECT_NE(text.find(each.words), std::string::npos) << each.words << "\n" << text;
    }
}

}  // namespace
}  // namespace cortex::modbus::test
