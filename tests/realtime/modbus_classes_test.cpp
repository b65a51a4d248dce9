// SPDX-License-Identifier: Apache-2.0
// The tick is sacred for each class of the plug-in cortex-modbus, too: in its states, while its
// link is cut and while it comes back. What is behind the link runs: simulators, and a server of
// libmodbus.
#include "cortex/toolkit/classes.hpp"
#include "cortex/toolkit/fieldbus_link.hpp"

#include "modbus/sim_process.hpp"
#include "modbus/test_servers.hpp"
#include "realtime/watched_cluster.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using cs::TestPlant;
using modbus::test::ModbusServer;
using modbus::test::SimProcess;
using toolkit::Link;

// What is behind the link.
struct Partner {
    virtual ~Partner() = default;
    virtual std::string address() = 0;
    virtual void leave() = 0;
    virtual void comeBack() = 0;
};

struct Simulator final : Partner {
    Simulator(std::vector<std::string> options, std::string program)
        : sim{std::move(options), std::move(program)} {}
    std::string address() override { return sim.address(); }
    void leave() override { sim.kill9(); }
    void comeBack() override { sim.restart(); }
    SimProcess sim;
};

struct Coupler final : Partner {
    std::string address() override { return server.address(); }
    void leave() override { server.leave(); }
    void comeBack() override { server.comeBack(); }
    ModbusServer server;
};

// How one class is made, and what it is told in a cycle.
struct ModbusClass {
    std::string type;
    std::function<std::unique_ptr<Partner>()> partner;
    std::function<void(TestPlant&, const TestPlant::Pairs& link)> build;
    std::function<void(TestPlant&, double turn)> tell;

    friend void PrintTo(const ModbusClass& each, std::ostream* out) { *out << each.type; }
};

TestPlant::Pairs operator+(TestPlant::Pairs one, const TestPlant::Pairs& other) {
    one.insert(one.end(), other.begin(), other.end());
    return one;
}

void buildDrive(TestPlant& plant, const TestPlant::Pairs& link) {
    plant.add("/seen", "Ds402RotaryObservation", {}, {{"homingNeeded", "false"}});
    plant.add("/told", "Ds402RotaryModification");
    plant.add("/it", "Ds402ModbusDrive", {{"demands", "/told"}, {"observations", "/seen"}},
              link + TestPlant::Pairs{{"watchdogTime", "5"}});
}

// Enabled word by word; then it moves, with a homing speed that is another one now and then.
void tellDrive(TestPlant& plant, double turn) {
    Simplex& told = plant.tree().at("/told");
    const int phase = static_cast<int>(turn * 10) % 40;
    told.data<std::int64_t>("controlWord") = phase < 2 ? 0x80 : phase < 4 ? 0x06 : 0x0F;
    told.data<double>("position") = phase < 8 ? 0 : phase == 30 ? 1e9 : 0.01 * std::sin(turn);
}

void buildCoupler(TestPlant& plant, const TestPlant::Pairs& link) {
    plant.add("/lamps", "DigitalOutputGroup");
    plant.add("/fans", "AnalogueOutputGroup");
    plant.add("/buttons", "DigitalInputGroup");
    plant.add("/levels", "AnalogueInputGroup");
    plant.add("/it", "ModbusIoDevice",
              {{"digitalOutputs", "/lamps"},
               {"analogueOutputs", "/fans"},
               {"digitalInputs", "/buttons"},
               {"analogueInputs", "/levels"}},
              link + TestPlant::Pairs{{"coilsAt", "0"},
                                      {"discreteInputsAt", "0"},
                                      {"inputRegistersAt", "0"},
                                      {"holdingRegistersAt", "0"}});
}

// Now and then a number that its register cannot hold, and none at all.
void tellCoupler(TestPlant& plant, double turn) {
    const int phase = static_cast<int>(turn * 10) % 40;
    plant.tree().at("/lamps").array<bool>("value")[0] = phase % 2 == 0;
    plant.tree().at("/fans").array<double>("value")[0] = phase == 10   ? 1e9
                                                         : phase == 20 ? std::nan("")
                                                                       : phase;
}

void buildGripper(TestPlant& plant, const TestPlant::Pairs& link) {
    plant.add("/wish", "LinearAxisModification");
    plant.add("/opening", "LinearAxisObservation");
    plant.add("/status", "GripperStatus");
    plant.add("/it", "RobotiqModbusGripper",
              {{"demands", "/wish"}, {"opening", "/opening"}, {"status", "/status"}}, link);
}

// Led to the fingers until they follow, as a controller does it.
void tellGripper(TestPlant& plant, double turn) {
    constexpr std::int64_t disabled = 6;
    const bool follows = plant.state("/it") == State::Active &&
                         plant.get<std::int64_t>("/opening", "status") != disabled;
    const double opening = plant.get<double>("/opening", "position");
    Simplex& wish = plant.tree().at("/wish");
    wish.data<double>("position") = follows ? 0.04 + 0.03 * std::sin(turn) : opening;
    wish.data<double>("velocity") = follows ? 0.03 * std::cos(turn) : 0;
    wish.data<double>("effort") = 30;
}

std::unique_ptr<Partner> simulatorOf(std::vector<std::string> options, const char* program) {
    return std::make_unique<Simulator>(std::move(options), program);
}

const std::vector<ModbusClass> modbusClasses{
    {"Ds402ModbusDrive",
     [] { return simulatorOf({"--axes", "1", "--absolute"}, "cortex-ds402-sim"); }, buildDrive,
     tellDrive},
    {"ModbusIoDevice", [] { return std::make_unique<Coupler>(); }, buildCoupler, tellCoupler},
    {"RobotiqModbusGripper",
     [] { return simulatorOf({"--activation-time", "0.01"}, "cortex-gripper-sim"); }, buildGripper,
     tellGripper},
};

// The class as `/it`, and a monitor of its link. A cycle is a tenth of a millisecond of nominal
// time, so no time of the machine decides anything.
class WatchedDevice : public TestPlant {
public:
    WatchedDevice(const ModbusClass& what, const std::string& address)
        : TestPlant{{CORTEX_SOURCE_DIR "/ontology/cortex-morphology.xml"},
                    std::chrono::microseconds{100}},
          what_{what} {
        toolkit::addClasses(classes());
        loadPlugin(CORTEX_MODBUS_PLUGIN);
        what.build(*this, {{"address", address},
                           {"exchangePeriod", "0.001"},
                           {"responseTimeout", "0.6"},
                           {"lossTime", "0.7"},
                           {"reconnectTime", "0.01"}});
        add("/links", "FieldbusMonitor", {{"devices", "/it"}});
        checker().watch(cluster());
        start();
        cluster().send("/links", "startup");
    }
    void see(int cycles = 1) {
        for (int i = 0; i < cycles; ++i) {
            what_.tell(*this, 0.01 * static_cast<double>(cycle()));
            step();
            (link() == Link::Open ? withLink : withoutLink).insert(state("/it"));
        }
    }
    void order(const std::string& command, int cycles) {
        cluster().send("/it", command);
        see(cycles);
    }
    void until(const std::string& what, const std::function<bool()>& condition) {
        waitUntil(what, [&] { return condition() || (see(), false); });
    }
    void exchanges(std::int64_t more) {
        const auto count = [this] { return get<std::int64_t>("/it", "exchangeCount"); };
        until("exchanges", [&, end = count() + more] { return count() >= end; });
    }
    void becomesActive() {
        until("an active device", [this] {
            if (state("/it") == State::Fault) cluster().send("/it", "clearFaults");
            if (state("/it") == State::Standby) cluster().send("/it", "startup");
            return state("/it") == State::Active;
        });
    }
    Link link() { return static_cast<Link>(get<std::int64_t>("/it", "link")); }
    bool isOpen() { return link() == Link::Open; }

    std::set<State> withLink, withoutLink;

private:
    const ModbusClass& what_;
};

class EveryModbusClass : public testing::TestWithParam<ModbusClass> {};

TEST_P(EveryModbusClass, NeitherAllocatesNorLocksNorCallsTheSystemWithALinkAndWithout) {
    checker().reset();
    const std::unique_ptr<Partner> partner = GetParam().partner();
    WatchedDevice plant{GetParam(), partner->address()};
    for (int round = 0; round < 2; ++round) {
        plant.until("an open link", [&] { return plant.isOpen(); });
        plant.becomesActive();
        plant.exchanges(100);
        plant.order("shutdown", 50);
        plant.order("reconnect", 50);
        plant.until("an open link", [&] { return plant.isOpen(); });
        plant.becomesActive();
        partner->leave();
        plant.until("a cut link", [&] { return !plant.isOpen(); });
        for (const char* command : {"shutdown", "startup", "shutdown", "startup", "clearFaults"})
            plant.order(command, 50);
        partner->comeBack();
    }
    plant.until("an open link", [&] { return plant.isOpen(); });
    plant.exchanges(20);

    EXPECT_EQ(violations(), "");
    using enum State;
    for (const State each : {Standby, StartingUp, Active, ShuttingDown})
        EXPECT_TRUE(plant.withLink.contains(each)) << name(each);
    for (const State each : {Standby, StartingUp, Active})
        EXPECT_TRUE(plant.withoutLink.contains(each)) << name(each) << " without a link";
    EXPECT_GE(plant.get<std::int64_t>("/it", "reconnectCount"), 4);
}

INSTANTIATE_TEST_SUITE_P(OfThePlugin, EveryModbusClass, testing::ValuesIn(modbusClasses),
                         [](const auto& each) { return each.param.type; });

TEST(ModbusClassesThatAreWatched, AreAllThatThePluginHas) {
    TestPlant plant{{CORTEX_SOURCE_DIR "/ontology/cortex-morphology.xml"}};
    plant.loadPlugin(CORTEX_MODBUS_PLUGIN);
    std::set<std::string> watched;
    for (const ModbusClass& each : modbusClasses) watched.insert(each.type);

    const std::vector<std::string> names = plant.classes().names();
    EXPECT_EQ(watched, (std::set<std::string>{names.begin(), names.end()}));
}

}  // namespace
}  // namespace cortex::test
