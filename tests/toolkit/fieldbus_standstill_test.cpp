// SPDX-License-Identifier: Apache-2.0
// An answer to what was asked before all of the process stood still. A wait makes it at least so
// old, whatever the machine does.
#include "cortex/core/registry.hpp"

#include "support/stepped_clock.hpp"
#include "toolkit/fieldbus_rig.hpp"

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

using namespace std::chrono_literals;

// A boiler in a loop that takes the steps of the test for real.
class FieldbusStandstill : public testing::Test {
protected:
    FieldbusStandstill() {
        registry_.add<Boiler>("Boiler");
        SystemDescription system;
        system.simplexes = {entry("/power", "BoilerPower"), entry("/water", "BoilerTemperature"),
                            entry("/boiler", "Boiler")};
        SystemDescription::SimplexEntry& boiler = system.simplexes.back();
        boiler.relates = {{"heater", "/power", false, false, {}},
                          {"water", "/water", false, false, {}}};
        boiler.settings = {{"address", server.address(), {}, false},
                           {"responseTimeout", "10", {}, false},
                           {"lossTime", "40", {}, false}};
        Report report;
        tree_.add(system, &registry_, report);
        if (!report.ok()) throw ModelError(std::move(report));
        cluster.addSimplexTree(tree_);
    }
    void TearDown() override { server.end(); }
    // Until the first request has come.
    void connect() {
        server.listen();
        cluster.start();
        clock.trigger.step();
        server.welcome();
        server.hear();
    }
    double age() { return cluster.image().get<double>("/boiler", "age"); }  // ms
    double temperature() { return cluster.image().get<double>("/water", "temperature"); }

    static SystemDescription::SimplexEntry entry(const std::string& path, const std::string& type) {
        SystemDescription::SimplexEntry entry;
        entry.path = path;
        entry.type = type;
        return entry;
    }

    BoilerServer server;
    ClassRegistry registry_;
    SimplexTree tree_{TypeModel::load(
        std::vector<std::filesystem::path>{CORTEX_SOURCE_DIR "/tests/data/fieldbus-rules.xml"})};
    cs::ClusterCS cluster{"plant", {}};
    cortex::test::SteppedClock& clock = cluster.setTriggerSource<cortex::test::SteppedClock>();
};

TEST_F(FieldbusStandstill, MakesAnAnswerAsOldAsItsRequest) {
    connect();
    std::this_thread::sleep_for(20ms);
    server.say(50);
    server.hear();  // the next request: the answer has come to the tick
    clock.trigger.step();

    EXPECT_EQ(temperature(), 50);
    EXPECT_GE(age(), 20);
}

}  // namespace
}  // namespace cortex::toolkit::test
