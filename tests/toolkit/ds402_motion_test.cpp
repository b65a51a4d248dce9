// SPDX-License-Identifier: Apache-2.0
// Whatever is commanded, no axis jumps.
#include "ds402_plant.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

constexpr double drivePeriod = 1e-3;  // s
constexpr double mostSpeed = 2.0;     // rad/s, of the demands' type

// Two axes with a jog controller, and somebody who presses any button at any time.
class AnyCommands {
public:
    AnyCommands() {
        plant_.begin();
        places_ = {plant_.place(1), plant_.place(2)};
    }
    // A sequence of commands, after which the usual way leads back to motion.
    void run(unsigned seed) {
        random_.seed(seed);
        log_ = "seed " + std::to_string(seed) + "\n";
        fastest_ = 0;
        for (int i = 0; i < 6; ++i) {
            command();
            step(uniform(1, 30));
        }
        recover();
    }
    std::string log() { return log_ + plant_.told(); }
    double fastest() const { return fastest_; }
    bool isReady() {
        return plant_.state("/it") == State::Active && plant_.enabled(1) && plant_.enabled(2);
    }

private:
    std::int64_t uniform(std::int64_t from, std::int64_t to) {
        return from + static_cast<std::int64_t>(random_() % static_cast<unsigned>(to - from + 1));
    }
    void send(const std::string& path, const std::string& name,
              const Rig::Arguments& arguments = {}) {
        log_ += path + " " + name + "\n";
        plant_.cluster().send(path, name, arguments);
    }
    void sendToAny(const std::string& name) { send("/it", name, {{"axis", uniform(0, 2)}}); }
    void setAnyMode() {
        constexpr std::array<std::int64_t, 6> modes{1, 3, 8, 8, 9, 10};
        const std::int64_t mode = modes[static_cast<std::size_t>(uniform(0, 5))];
        send("/it", "setMode", {{"axis", uniform(0, 2)}, {"mode", mode}});
    }
    void failOrClear() {
        if (uniform(0, 2) == 0) plant_.axis(1).model.fail(0x2310, false);
        send("/it", "clearFaults");
    }
    void command() {
        switch (uniform(0, 10)) {
            case 0:
                return send("/it", "step", {{"axis", uniform(1, 2)}, {"word", uniform(1, 7)}});
            case 1:
                return setAnyMode();
            case 2:
                return send("/it", uniform(0, 1) == 0 ? "shutdown" : "startup");
            case 3:
                return failOrClear();
            case 4:
                return sendToAny("resetFault");
            case 5:
                return sendToAny("quickStop");
            case 6:
                return sendToAny("disable");
            case 7:
                return sendToAny("enable");
            default:
                return send("/jog", "jog",
                            {{"axis", uniform(1, 2)},
                             {"velocity", static_cast<double>(uniform(-15, 15)) * 0.1}});
        }
    }
    void step(std::int64_t cycles) {
        for (std::int64_t i = 0; i < cycles; ++i) {
            plant_.step();
            for (const int number : {1, 2}) {
                double& before = places_[static_cast<std::size_t>(number - 1)];
                const double now = plant_.place(number);
                fastest_ = std::max(fastest_, std::abs(now - before) / drivePeriod);
                before = now;
            }
        }
    }
    void recover() {
        send("/it", "shutdown");
        stepUntil(State::Standby, State::Fault);
        for (int i = 0; i < 50 && plant_.state("/it") == State::Fault; ++i) {
            plant_.cluster().send("/it", "clearFaults");  // refused while a drive reacts
            step(20);
        }
        send("/it", "setMode", {{"axis", std::int64_t{0}}, {"mode", std::int64_t{8}}});
        if (plant_.driveState(1) == drives::Ds402State::Fault) {
            send("/it", "resetFault", {{"axis", std::int64_t{1}}});
            step(80);
        }
        send("/it", "startup");
        step(2);
        stepUntil(State::Active, State::Fault);
    }
    void stepUntil(State one, State other) {
        for (int i = 0; i < 1000 && plant_.state("/it") != one && plant_.state("/it") != other; ++i)
            step(1);
    }

    DrivePlant plant_{PlantOptions{.jogs = true}};
    std::mt19937 random_;
    std::vector<double> places_;
    std::string log_;
    double fastest_ = 0;
};

TEST(RandomCommands, NeverMakeAnAxisFasterThanItMayBeAndLeadBackToMotion) {
    AnyCommands any;
    for (unsigned seed = 0; seed < 200; ++seed) {
        any.run(seed);

        ASSERT_LE(any.fastest(), mostSpeed) << any.log();
        ASSERT_TRUE(any.isReady()) << any.log();
    }
}

// An axis that was turned by hand while it had no torque.
TEST(AnEnabledAxis, StandsWhereItIsAndNotWhereItsTargetWas) {
    DrivePlant plant;
    plant.begin();
    plant.moveDemand(1, 0.5);
    plant.step(100);
    ASSERT_TRUE(plant.ask("disable", 1).done());
    plant.step(300);
    plant.demand(1, 0.508);
    plant.step(5);
    ASSERT_TRUE(plant.ask("enable", 1).done());
    double before = plant.place(1), fastest = 0;
    for (int i = 0; i < 800; ++i) {
        plant.step();
        fastest = std::max(fastest, std::abs(plant.place(1) - before) / drivePeriod);
        before = plant.place(1);
    }

    EXPECT_LT(fastest, 0.05) << "it goes there, slowly";
    EXPECT_NEAR(plant.place(1), 0.508, 1e-3);
}

TEST(AnEnabledAxis, IsNotLedToADemandThatHasMovedMeanwhile) {
    DrivePlant plant;
    plant.begin();
    ASSERT_TRUE(plant.ask("disable", 1).done());
    plant.step(300);
    ASSERT_TRUE(plant.ask("enable", 1).done());
    plant.step(3);
    plant.demand(1, 0.5);
    plant.step(1500);

    EXPECT_NEAR(plant.place(1), 0, 1e-3);
    EXPECT_TRUE(plant.hasTold("axis 1 waits for its demand, which is 0.5 away")) << plant.told();
    EXPECT_EQ(plant.state("/it"), State::Active);
}

TEST(AnEnabledAxis, FollowsOnlyOnceItsDriveDoes) {
    DrivePlant plant;
    plant.begin();
    ASSERT_TRUE(plant.ask("disable", 1).done());
    plant.step(300);
    ASSERT_TRUE(plant.ask("enable", 1).done());
    while (plant.get<std::int64_t>("/set/a", "controlWord") != 15) plant.step();
    double before = plant.place(1), fastest = 0;
    for (int i = 0; i < 400; ++i) {  // the demand moves on while the brake opens
        plant.demand(1, std::min(0.5, i * 2e-4), 0.2);
        plant.step();
        fastest = std::max(fastest, std::abs(plant.place(1) - before) / drivePeriod);
        before = plant.place(1);
    }

    EXPECT_TRUE(plant.enabled(1));
    EXPECT_LT(fastest, 0.3);
}

}  // namespace
}  // namespace cortex::toolkit::test
