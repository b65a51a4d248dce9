// SPDX-License-Identifier: Apache-2.0
#include "cortex/toolkit/classes.hpp"

#include "toolkit/fieldbus_rig.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

// One boiler that answers, and one whose place somebody else has taken.
class FieldbusMonitorTest : public testing::Test {
protected:
    FieldbusMonitorTest() {
        addClasses(plant.classes());
        plant.add("/power2", "BoilerPower");
        plant.add("/water2", "BoilerTemperature");
        plant.add("/boiler2", "Boiler", {{"heater", "/power2"}, {"water", "/water2"}},
                  {{"address", stranger.address()},
                   {"exchangePeriod", "0.001"},
                   {"responseTimeout", "10"},
                   {"lossTime", "40"},
                   {"reconnectTime", "60"}});
        plant.add("/links", "FieldbusMonitor", {{"devices", "/boiler"}, {"devices", "/boiler2"}});
        server.listen();
        stranger.listen();
        plant.start();
        server.welcome();
        server.hear();
        stranger.accept();
        stranger.say(BoilerServer::identity + 1);
        plant.stepUntil("a refused device", [this] { return count("refused") == 1; });
    }
    void TearDown() override {
        server.end();
        stranger.end();
    }
    std::int64_t count(const std::string& item) { return plant.get<std::int64_t>("/links", item); }
    double ageOf(const std::string& path) { return plant.get<double>(path, "age"); }

    BoilerServer server, stranger;
    BoilerPlant plant{server.address()};
};

TEST_F(FieldbusMonitorTest, CountsInStandbyWhichLinksAreOpenRefusedAndLost) {
    server.say(50);
    server.hear();
    plant.step();

    EXPECT_EQ(plant.state("/links"), State::Standby);
    EXPECT_EQ(count("deviceCount"), 2);
    EXPECT_EQ(count("open"), 1);
    EXPECT_EQ(count("refused"), 1);
    EXPECT_EQ(count("lost"), 1) << "the one that never answered";

    plant.step(50);
    EXPECT_EQ(count("open"), 1) << "nobody has closed it";
    EXPECT_EQ(count("lost"), 2) << "silent for longer than lossTime";
}

TEST_F(FieldbusMonitorTest, TellsTheAgeOfTheOneThatHasBeenSilentForTheLongest) {
    server.say(50);
    server.hear();
    plant.step(7);

    EXPECT_GT(ageOf("/boiler2"), ageOf("/boiler"));
    EXPECT_EQ(plant.get<double>("/links", "worstAge"), ageOf("/boiler2")) << "of this cycle";
}

TEST_F(FieldbusMonitorTest, IsGoodItselfWhileItsDevicesAreLost) {
    plant.step(50);
    plant.call("/links", "startup");
    plant.step();

    const Image image = plant.cluster().image();
    EXPECT_EQ(plant.state("/links"), State::Active);
    EXPECT_EQ(count("lost"), 2);
    EXPECT_EQ(image.state(image.structure().find("/links")).quality, Quality::Good);
}

}  // namespace
}  // namespace cortex::toolkit::test
