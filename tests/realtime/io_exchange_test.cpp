// SPDX-License-Identifier: Apache-2.0
// A device that blocks, is lost, throws and is back: the tick beside it stays what it was.
#include "cortex/cs/io_exchange.hpp"

#include "cortex/toolkit/fieldbus_device.hpp"

#include "realtime/watched_cluster.hpp"

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>

#include <unistd.h>

#include <gtest/gtest.h>

namespace cortex::test {

namespace {

using namespace std::chrono_literals;

class RestlessDrive final : public cs::IoSimplex<double, double> {
public:
    using IoSimplex::IoSimplex;
    std::atomic<int> throws{0};

private:
    void populate() override {
        demand_ = input("demand").data<double>("position");
        position_ = output("observation").data<double>("position");
        loseAfter(3ms);
    }
    void loopEnd(const Tick&) override {
        if (!isLost()) position_ = received();
        give(demand_);
    }
    void communicate(Line& line) override {
        for (int round = 1; line.waitFor(200us); ++round) {
            const double* demand = line.demand();
            line.put(demand == nullptr ? 0 : *demand);
            if (round % 50 == 0) line.waitFor(10ms);
            if (round % 70 == 0) line.lose("it was asked to be");
            if (round % 200 == 0) {
                ++throws;
                throw std::runtime_error("asked for by the test");
            }
        }
    }
    Data<const double> demand_;
    Data<double> position_;
};

TEST(BlockingDevice, DisturbsNoTickWhateverItsThreadDoes) {
    checker().reset();
    SimplexTree tree{TypeModel::load(std::string{CORTEX_SOURCE_DIR} + "/tests/data/cs-rules.xml")};
    auto& drive = tree.add<RestlessDrive>("/drive", "Drive");
    tree.relate(drive, "demand", tree.add("/wish", "Demand"));
    tree.relate(drive, "observation", tree.add("/axis", "Observation"));
    cs::ClusterCS cluster{"watched", optionsOf(1, geteuid() == 0 ? 10 : 0)};
    watch(cluster, 1);
    cluster.addSimplexTree(tree);
    cluster.setTriggerSource<WatchedClock>();
    cluster.start();
    runCycles(cluster, 100);
    const auto killAndClear = [&](int deaths) {
        waitUntil(
            std::to_string(deaths) + " throws", [&] { return drive.throws >= deaths; },
            [&] { return std::to_string(drive.throws); });
        runCycles(cluster, 10);
        EXPECT_EQ(cluster.image().get<std::int64_t>("/drive", "state"), 4);
        EXPECT_EQ(cluster.call("/drive", "clearFaults").outcome, Outcome::Done);
    };
    killAndClear(1);  // what runs for the first time may meet a page of code
    const std::uint64_t faultsBefore = checker().counts().pageFaults;

    for (int deaths = 2; deaths <= 4; ++deaths) killAndClear(deaths);

    EXPECT_EQ(violations(), "");
    EXPECT_EQ(checker().counts().pageFaults, faultsBefore);
    cluster.stop();
}

// Its link is refused, breaks and is opened again; a hook asks for work all the time.
class RestlessBoiler final : public toolkit::FieldbusDevice<double, double> {
public:
    using FieldbusDevice::FieldbusDevice;

private:
    void populate() override {
        power_ = input("heater").data<double>("power");
        temperature_ = output("water").data<double>("temperature");
        populateLink();
        work_ = atDevice([this] {
            if (++works_ % 30 == 0) throw toolkit::LinkError("it was asked to break");
        });
    }
    void connect() override {
        if (++connects_ % 3 == 0) throw toolkit::LinkRefused("it is refused now and then");
    }
    void exchange(const double& power, double& temperature) override {
        if (++exchanges_ % 50 == 0) throw toolkit::LinkError("it breaks now and then");
        temperature = power;
    }
    void close() noexcept override {}
    void pack(double& power) override { power = power_; }
    void quiet(double& power) override { power = 0; }
    void unpack(const double& temperature) override { temperature_ = temperature; }
    void stateStandby(const Tick&) override {
        if (!work_.isRunning() && !work_.failure().empty()) ++failures_;
        work_.begin();
    }
    Data<const double> power_;
    Data<double> temperature_;
    cs::SlowWork work_;
    int works_ = 0, connects_ = 0, exchanges_ = 0;  // of the thread
    int failures_ = 0;
};

TEST(FieldbusDevice, DisturbsNoTickWhileItsLinkBreaksAndComesBack) {
    checker().reset();
    SimplexTree tree{
        TypeModel::load(std::string{CORTEX_SOURCE_DIR} + "/tests/data/fieldbus-rules.xml")};
    auto& boiler = tree.add<RestlessBoiler>("/boiler", "Boiler");
    boiler.set("reconnectTime", 0.01);
    tree.relate(boiler, "heater", tree.add("/power", "BoilerPower"));
    tree.relate(boiler, "water", tree.add("/water", "BoilerTemperature"));
    cs::ClusterCS cluster{"watched", optionsOf(1, geteuid() == 0 ? 10 : 0)};
    watch(cluster, 1);
    cluster.addSimplexTree(tree);
    cluster.setTriggerSource<WatchedClock>();
    cluster.start();
    const auto count = [&](const char* item) {
        return cluster.image().get<std::int64_t>("/boiler", item);
    };
    waitUntil("links that broke", [&] { return count("reconnectCount") >= 4; });
    EXPECT_EQ(cluster.call("/boiler", "reconnect").outcome, Outcome::Done);
    const std::int64_t before = count("reconnectCount");
    waitUntil("one more", [&] { return count("reconnectCount") > before; });

    EXPECT_GT(count("exchangeCount"), 50);
    EXPECT_GE(count("errorCount"), 4);
    EXPECT_EQ(violations(), "");
    cluster.stop();
}

}  // namespace

}  // namespace cortex::test
