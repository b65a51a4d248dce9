// SPDX-License-Identifier: Apache-2.0
// What a device behind a socket is told: demands, quiet ones, requests, to connect anew.
#include "cortex/core/error.hpp"
#include "cortex/core/quality.hpp"

#include "toolkit/fieldbus_rig.hpp"

#include <chrono>
#include <future>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

using namespace std::chrono_literals;

class FieldbusOrders : public testing::Test {
protected:
    explicit FieldbusOrders(const cs::TestPlant::Pairs& settings = {})
        : plant{server.address(), settings} {}
    void TearDown() override { server.end(); }

    void connect() {
        server.listen();
        plant.start();
        server.welcome();
        server.hear();
    }
    // The first request that was made of the last cycle's demand.
    double exchange(double temperature = 50) {
        server.say(temperature);
        server.hear();
        server.say(temperature);
        return server.hear();
    }
    void demand(double power) { plant.tree().at("/power").data<double>("power") = power; }
    // Begun in a hook.
    void ask() {
        plant.boiler().asks = true;
        plant.step();
        EXPECT_TRUE(plant.boiler().wasBegun);
    }
    std::string failure() {
        plant.stepUntil("the end", [this] { return !plant.boiler().asked.isRunning(); });
        return std::string{plant.boiler().asked.failure()};
    }

    BoilerServer server;
    BoilerPlant plant;
};

class FieldbusAtTheEnd : public FieldbusOrders {
protected:
    FieldbusAtTheEnd() : FieldbusOrders{{{"exchangePeriod", "10"}}} {}
};

class FieldbusReconnect : public FieldbusOrders {
protected:
    FieldbusReconnect() : FieldbusOrders{{{"reconnectTime", "60"}}} {}
};

TEST_F(FieldbusOrders, AreTheNewestDemandInEachState) {
    connect();
    demand(42);
    plant.step();
    EXPECT_EQ(exchange(), 42) << "in Standby";
    plant.startUp();
    demand(43);
    plant.step();
    EXPECT_EQ(exchange(), 43);
}

TEST_F(FieldbusOrders, AreQuietWhileNobodySpeaksForTheDemandAndInFault) {
    connect();
    demand(42);
    plant.tree().at("/power").slot().quality = Quality::Lost;
    plant.step();
    EXPECT_EQ(exchange(), Boiler::quietPower);
    plant.tree().at("/power").slot().quality = Quality::Good;
    plant.step();
    EXPECT_EQ(exchange(), 42);

    plant.boiler().faults = true;
    plant.step(2);  // the first one ends in Fault
    ASSERT_EQ(plant.state("/boiler"), State::Fault);
    EXPECT_EQ(exchange(), Boiler::quietPower);
    plant.step();
    EXPECT_EQ(plant.quality(), Quality::Good) << "it measures in every state";
}

TEST_F(FieldbusAtTheEnd, AreThoseOfTheLastCycleInALastExchange) {
    connect();
    auto later = std::async(std::launch::async, [this] {
        server.say(50);
        const double last = server.hear();
        server.say(50);
        return last;
    });
    plant.stepUntil("an answer", [this] { return plant.count("exchangeCount") == 1; });
    demand(42);
    plant.step();
    plant.cluster().stop();
    EXPECT_EQ(later.get(), 42);
    EXPECT_TRUE(server.isLeft());
}

TEST_F(FieldbusReconnect, ClosesTheLinkAndOpensItAtOnceAndIsNoError) {
    connect();
    exchange();
    plant.step();
    EXPECT_TRUE(plant.call("/boiler", "reconnect").done());
    server.say(50);
    EXPECT_TRUE(server.isLeft());
    server.accept();
    plant.step();
    EXPECT_EQ(plant.quality(), Quality::Lost);
    plant.step();
    EXPECT_TRUE(plant.hasEvent("it connects anew, as it was commanded to"));
    server.say(BoilerServer::identity);
    server.hear();
    exchange(60);
    plant.step();
    EXPECT_EQ(plant.quality(), Quality::Good);
    EXPECT_EQ(plant.count("reconnectCount"), 1);
    EXPECT_EQ(plant.count("errorCount"), 0);
}

TEST_F(FieldbusReconnect, EndsTheWaitForTheNextTry) {
    plant.start();
    plant.stepUntil("a first try", [this] { return plant.count("errorCount") == 1; });
    server.listen();
    plant.step();
    EXPECT_EQ(plant.link(), Link::Closed) << "it would wait for a minute";
    EXPECT_TRUE(plant.call("/boiler", "reconnect").done());
    server.accept(20s);
    server.say(BoilerServer::identity);
    server.hear();
}

TEST_F(FieldbusOrders, OfHooksAreDoneBetweenTwoExchanges) {
    connect();
    double told = 0;
    plant.boiler().work = [&] { told = 7; };
    exchange();
    ask();
    EXPECT_TRUE(plant.boiler().asked.isRunning()) << "the thread waits for an answer";
    server.say(50);
    server.hear();
    EXPECT_FALSE(plant.boiler().asked.isRunning());
    EXPECT_EQ(plant.boiler().asked.failure(), "");
    EXPECT_EQ(told, 7);
}

TEST_F(FieldbusOrders, OfHooksThatFindTheLinkBrokenCloseIt) {
    connect();
    plant.boiler().work = [] { throw LinkError("6098h: no answer; is the drive on?"); };
    exchange();
    ask();
    server.say(50);
    EXPECT_TRUE(server.isLeft());
    EXPECT_EQ(failure(), "6098h: no answer; is the drive on?");
    plant.stepUntil("the event", [this] {
        return plant.hasEvent("the device is lost: 6098h: no answer; is the drive on?");
    });
    EXPECT_EQ(plant.count("errorCount"), 1);
    server.welcome();
    server.hear();
}

TEST_F(FieldbusReconnect, OfHooksEndAsFailedWhileTheDeviceIsAway) {
    bool wasDone = false;
    plant.start();
    plant.boiler().work = [&] { wasDone = true; };
    plant.stepUntil("a first try", [this] { return plant.count("errorCount") == 1; });
    ask();
    EXPECT_EQ(failure(), "the device is away: " + server.address() +
                             ": Connection refused; is the boiler on?");
    EXPECT_FALSE(wasDone);
}

}  // namespace
}  // namespace cortex::toolkit::test
