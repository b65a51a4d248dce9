// SPDX-License-Identifier: Apache-2.0
// A device behind a real socket that answers in time, late, wrong, not at all. Before each look the
// server has heard the next request, so that the answer to the one before has come to the tick.
#include "cortex/core/error.hpp"

#include "toolkit/fieldbus_rig.hpp"

#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <thread>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

using namespace std::chrono_literals;

constexpr double noNumber = std::numeric_limits<double>::quiet_NaN();

class FieldbusDeviceTest : public testing::Test {
protected:
    void TearDown() override { server.end(); }
    // Until the first request has come.
    void connect() {
        server.listen();
        plant.start();
        server.welcome();
        server.hear();
    }
    // Answers the request that was heard, and hears the next one.
    double exchange(double temperature) {
        server.say(temperature);
        return server.hear();
    }
    void expectBackAfter(const std::string& reason) {
        plant.stepUntil("a lost device", [this] { return plant.quality() == Quality::Lost; });
        plant.step();
        EXPECT_TRUE(plant.hasEvent("the device is lost: " + server.address() + ": " + reason));
        EXPECT_EQ(plant.temperature(), 50) << "the last one that came";
        EXPECT_EQ(plant.count("errorCount"), 1);
        EXPECT_EQ(plant.state("/boiler"), State::Standby) << "it is no fault";
        const double age = plant.age();
        EXPECT_GT(age, 0);

        server.accept();
        plant.step();
        EXPECT_EQ(plant.link(), Link::Connecting);
        EXPECT_GT(plant.age(), age);
        server.say(BoilerServer::identity);
        server.hear();
        plant.step();
        EXPECT_EQ(plant.link(), Link::Open);
        EXPECT_EQ(plant.quality(), Quality::Lost) << "there was no whole answer yet";
        EXPECT_GT(plant.age(), age + 1);
        exchange(60);
        plant.step();
        EXPECT_EQ(plant.quality(), Quality::Good);
        EXPECT_EQ(plant.temperature(), 60);
        EXPECT_EQ(plant.age(), 0);
        EXPECT_EQ(plant.count("reconnectCount"), 1);
        EXPECT_EQ(plant.count("errorCount"), 1);
        plant.step();
        EXPECT_TRUE(plant.hasEvent("the device is back"));
    }

    BoilerServer server;
    BoilerPlant plant{server.address()};
};

TEST_F(FieldbusDeviceTest, ConnectsInStandbyAndShowsEachWholeAnswerWithItsAge) {
    connect();
    plant.step();
    EXPECT_EQ(plant.link(), Link::Open);
    EXPECT_EQ(plant.quality(), Quality::Lost) << "before the first answer";
    EXPECT_EQ(plant.count("exchangeCount"), 0);
    EXPECT_EQ(plant.temperature(), 20) << "what its type says, and no measured zero";

    exchange(50);
    plant.step();
    EXPECT_EQ(plant.state("/boiler"), State::Standby);
    EXPECT_EQ(plant.quality(), Quality::Good);
    EXPECT_EQ(plant.temperature(), 50);
    EXPECT_EQ(plant.age(), 0);
    EXPECT_EQ(plant.count("exchangeCount"), 1);

    exchange(51);
    exchange(52);
    plant.step(3);
    EXPECT_EQ(plant.temperature(), 52);
    EXPECT_EQ(plant.age(), 2);
    EXPECT_EQ(plant.count("exchangeCount"), 3);
    EXPECT_EQ(plant.count("errorCount"), 0);
    EXPECT_EQ(plant.count("reconnectCount"), 0);
    EXPECT_EQ(plant.events(), "");
}

TEST_F(FieldbusDeviceTest, SaysHowLongItsExchangesTake) {
    connect();
    for (int i = 0; i < 20; ++i) exchange(50);
    plant.step();
    const auto time = [this](const char* item) { return plant.get<double>("/boiler", item); };
    EXPECT_GT(time("exchangeTimeLast"), 0);
    EXPECT_LE(time("exchangeTimeLast"), time("exchangeTimeMax"));
    EXPECT_GT(time("exchangeTimeP99"), 0);
    EXPECT_LE(time("exchangeTimeP99"), time("exchangeTimeMax"));
}

TEST_F(FieldbusDeviceTest, ThatIsSilentIsStaleAfterThreePeriodsAndLostAfterLossTimeUntilItAnswers) {
    connect();
    exchange(50);
    plant.step(4);
    EXPECT_EQ(plant.quality(), Quality::Good) << "3 s old";
    plant.step();
    EXPECT_EQ(plant.quality(), Quality::Stale);
    EXPECT_FALSE(plant.boiler().isLost());
    plant.step(36);
    EXPECT_EQ(plant.quality(), Quality::Stale) << "40 s old";
    EXPECT_EQ(plant.events(), "");
    plant.step();
    EXPECT_EQ(plant.quality(), Quality::Lost);
    EXPECT_EQ(plant.link(), Link::Open) << "nobody has closed it";
    EXPECT_EQ(plant.age(), 41);
    plant.step();
    EXPECT_TRUE(plant.hasEvent("the device is lost: thread io-boiler has given no value for 41 s"));

    exchange(60);
    plant.step();
    EXPECT_EQ(plant.quality(), Quality::Good);
    EXPECT_EQ(plant.age(), 0);
    EXPECT_EQ(plant.temperature(), 60);
    EXPECT_EQ(plant.count("errorCount"), 0);
}

// It can only take longer than that it waits.
TEST_F(FieldbusDeviceTest, CountsAnAnswerThatIsLateAndTakesIt) {
    connect();
    std::this_thread::sleep_for(3ms);
    exchange(50);
    plant.step();
    EXPECT_GE(plant.count("lateCount"), 1);
    EXPECT_EQ(plant.count("errorCount"), 0);
    EXPECT_EQ(plant.quality(), Quality::Good);
    EXPECT_EQ(plant.temperature(), 50);
    EXPECT_GE(plant.get<double>("/boiler", "exchangeTimeMax"), 3000);
}

TEST(FieldbusPeriod, IsThatOfTheDeviceWhereItStatesOneAndWhatIsInTimeIsNotLate) {
    BoilerServer server;
    BoilerPlant plant{server.address(), {{"exchangePeriod", "10"}}};
    server.listen();
    plant.start();
    server.welcome();
    server.hear();
    server.say(50);
    plant.stepUntil("an answer", [&] { return plant.count("exchangeCount") == 1; });
    EXPECT_EQ(plant.count("lateCount"), 0);
    server.end();
}

TEST_F(FieldbusDeviceTest, ThatHangsUpIsLostAtOnceAndConnectsAnew) {
    connect();
    exchange(50);
    plant.step();
    server.hangUp();
    expectBackAfter("it hung up");
}

TEST_F(FieldbusDeviceTest, WhoseAnswerIsWrongIsLostAtOnceAndConnectsAnew) {
    connect();
    exchange(50);
    plant.step();
    server.say(noNumber);
    expectBackAfter("its answer is no temperature");
}

TEST(FieldbusTimeout, ClosesALinkThatDoesNotAnswerInTime) {
    BoilerServer server;
    BoilerPlant plant{server.address(), {{"responseTimeout", "0.02"}}};
    server.listen();
    plant.start();
    server.accept();  // and says nothing
    plant.stepUntil("the event", [&] { return plant.hasEvent(server.address() + ": no answer"); });
    EXPECT_TRUE(server.isLeft());
    EXPECT_EQ(plant.quality(), Quality::Lost);
    EXPECT_GE(plant.count("errorCount"), 1);
    server.end();
}

TEST_F(FieldbusDeviceTest, ThatIsAnotherOneIsRefusedAndTriedAgain) {
    server.listen();
    plant.start();
    server.accept();
    server.say(9);
    plant.stepUntil("a refused link", [this] { return plant.link() == Link::Refused; });
    EXPECT_EQ(plant.quality(), Quality::Lost);
    plant.step();
    EXPECT_TRUE(plant.hasEvent("the device is lost: " + server.address() +
                               ": it is another device; is the address right?"));
    EXPECT_EQ(plant.count("errorCount"), 1);

    server.welcome();
    server.hear();
    exchange(50);
    plant.step();
    EXPECT_EQ(plant.link(), Link::Open);
    EXPECT_EQ(plant.quality(), Quality::Good);
    EXPECT_EQ(plant.count("reconnectCount"), 0) << "it was open for the first time";
}

TEST_F(FieldbusDeviceTest, ThatIsSwitchedOffAtTheStartIsMissedAndFoundLater) {
    plant.start();
    plant.stepUntil("the event", [this] {
        return plant.hasEvent(server.address() + ": Connection refused; is the boiler on?");
    });
    EXPECT_EQ(plant.state("/boiler"), State::Standby);
    EXPECT_EQ(plant.quality(), Quality::Lost);

    server.listen();
    server.welcome();
    server.hear();
    exchange(50);
    plant.step();
    EXPECT_EQ(plant.quality(), Quality::Good);
}

TEST_F(FieldbusDeviceTest, ThatThrowsAnythingElseIsInFaultWithItsLinkClosed) {
    connect();
    exchange(50);
    plant.boiler().isWrong = true;
    server.say(51);
    plant.stepUntil("a fault", [this] { return plant.state("/boiler") == State::Fault; });
    EXPECT_TRUE(server.isLeft());
    plant.stepUntil("a closed link", [this] { return plant.link() == Link::Closed; });
    EXPECT_EQ(plant.count("faultCode"), -8);
    EXPECT_EQ(plant.quality(), Quality::Lost);
    EXPECT_TRUE(plant.hasEvent("fault -8: it cannot count"));

    plant.step();
    const CallResult cleared = plant.call("/boiler", "clearFaults");
    EXPECT_TRUE(cleared.done()) << cleared.text();
    server.welcome();
    server.hear();
    exchange(60);
    plant.step();
    EXPECT_EQ(plant.quality(), Quality::Good);
}

TEST(FieldbusTimes, ThatContradictEachOtherAreRefusedWithTheRemedy) {
    const auto refusal = [](const cs::TestPlant::Pairs& settings) -> std::string {
        BoilerPlant plant{"127.0.0.1:1", settings};
        try {
            plant.start();
        } catch (const ModelError& error) {
            return error.what();
        }
        return "it started";
    };
    EXPECT_NE(refusal({{"lossTime", "5"}, {"responseTimeout", "5"}}).find("'lossTime' is 5 s"),
              std::string::npos);
    EXPECT_NE(refusal({{"lossTime", "1.5"}, {"responseTimeout", "0.5"}})
                  .find("lossTime is 1.5 s, but it exchanges once in 1 s, so that one late answer "
                        "would lose it; set lossTime to at least 2 s"),
              std::string::npos);
    EXPECT_NE(refusal({{"exchangePeriod", "10"}, {"lossTime", "19"}, {"responseTimeout", "1"}})
                  .find("it exchanges once in 10 s"),
              std::string::npos);
}

}  // namespace
}  // namespace cortex::toolkit::test
