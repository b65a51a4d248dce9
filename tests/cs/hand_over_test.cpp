// SPDX-License-Identifier: Apache-2.0
// A manager exchanges the controllers of a demand: no cycle without one of them, no conflict.
#include "cortex/core/error.hpp"
#include "cortex/cs/testing.hpp"

#include "support/probe.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {

namespace {

// Controllers of shared demands, who start and stop as a manager says, and a device.
struct ControllerExchange {
    ProbeCluster cluster;
    Probe& manager = cluster.probe("/manager");
    Probe& drive = cluster.tree.add<Probe>("/drive", "Probe");
    std::vector<Probe*> controllers;
    std::vector<Probe::LifeCycleSender> choices;
    std::vector<bool> wanted;  // by controller
    Probe::HandOver step = Probe::HandOver::Failed;
    std::vector<double> executed;          // of the first demand, in each cycle
    std::vector<std::size_t> activeCount;  // of the controllers, in each cycle

    // Each controller writes its number, from 1, to the demand with the path given for it.
    explicit ControllerExchange(const std::vector<std::string>& demands, std::uint32_t threads = 1,
                                const std::string& type = "SharedSignal")
        : cluster{{.threads = threads}} {
        cs::ClusterTesting::set(*cluster.cluster, {.forceThreads = true, .chunkSize = 1});
        cluster.tree.relate(drive, "in", cluster.tree.add("/a", type));
        if (std::ranges::find(demands, "/b") != demands.end()) cluster.tree.add("/b", type);
        for (const std::string& demand : demands) {
            Probe& controller = cluster.probe("/c" + std::to_string(controllers.size() + 1));
            cluster.tree.relate(controller, "out", cluster.tree.at(demand));
            cluster.tree.relate(manager, "after", controller);
            write(controller, static_cast<double>(controllers.size() + 1));
            controllers.push_back(&controller);
        }
        wanted.resize(controllers.size());
        manager.onPopulate = [this](Probe& self) {
            for (const OutputSimplex& each : self.outputs("after"))
                choices.push_back(self.lifeCycle(each, true));
        };
        manager.onActive = [this](Probe&, const Tick& tick) {
            step = Probe::LifeCycleSender::handOver(
                choices, [this](std::size_t place) { return wanted[place]; }, tick);
        };
        drive.onPopulate = [this](Probe& self) {
            self.onLoopEnd = [this, value = self.input("in").data<double>("value")](
                                 Probe&, const Tick&) { executed.push_back(value); };
        };
    }

    static void write(Probe& controller, double number) {
        controller.onPopulate = [number](Probe& self) {
            self.onActive = [out = self.output("out").data<double>("value"), number](
                                Probe&, const Tick&) mutable { out = number; };
        };
    }

    void want(const std::vector<std::size_t>& places) {
        wanted.assign(wanted.size(), false);
        for (const std::size_t place : places) wanted[place] = true;
    }
    void run(int cycles) {
        for (int i = 0; i < cycles; ++i) {
            cluster.step();
            activeCount.push_back(
                static_cast<std::size_t>(std::ranges::count_if(controllers, [this](Probe* each) {
                    return cluster.state(each->path()) == State::Active;
                })));
        }
    }
    void start(const std::vector<std::size_t>& first) {
        want(first);
        cluster.start();
        cluster.startup(manager);
        run(10);
        executed.clear();
        activeCount.clear();
    }
    State state(std::size_t place) { return cluster.state(controllers[place]->path()); }
    std::int64_t conflicts() { return cluster.integer("/test", "conflictCount"); }
};

class HandOverOfADemand : public testing::TestWithParam<std::uint32_t> {};

TEST_P(HandOverOfADemand, LeavesNoCycleWithoutAControllerAndOneWithBoth) {
    ControllerExchange exchange{{"/a", "/a"}, GetParam()};
    exchange.start({0});
    EXPECT_EQ(exchange.step, Probe::HandOver::Done);

    exchange.want({1});
    exchange.run(8);

    // Starting up, both Active, shutting down, and then at rest.
    EXPECT_EQ(exchange.activeCount, (std::vector<std::size_t>{1, 2, 1, 1, 1, 1, 1, 1}));
    EXPECT_EQ(exchange.executed, (std::vector<double>{1, 2, 2, 2, 2, 2, 2, 2}));
    EXPECT_EQ(exchange.step, Probe::HandOver::Done);
    EXPECT_EQ(exchange.state(0), State::Standby);
    EXPECT_EQ(exchange.conflicts(), 0);
    EXPECT_FALSE(exchange.cluster.hasEvent("several writers are Active"));
}

TEST_P(HandOverOfADemand, GoesBothWaysInCanonicalOrder) {
    ControllerExchange exchange{{"/a", "/a"}, GetParam()};
    exchange.start({1});

    exchange.want({0});
    exchange.run(4);

    EXPECT_EQ(exchange.executed, (std::vector<double>{2, 1, 1, 1}));
    EXPECT_EQ(exchange.conflicts(), 0);
}

INSTANTIATE_TEST_SUITE_P(Threads, HandOverOfADemand, testing::Values(1U, 2U, 4U));

TEST(HandOver, OfASingleOneIsTheSame) {
    ControllerExchange exchange{{"/a", "/a"}};
    std::size_t to = 0;
    exchange.manager.onActive = [&](Probe&, const Tick& tick) {
        exchange.step = exchange.choices[1 - to].handOver(exchange.choices[to], tick);
    };
    exchange.start({});
    to = 1;
    exchange.run(5);

    EXPECT_EQ(exchange.executed, (std::vector<double>{1, 2, 2, 2, 2}));
    EXPECT_EQ(exchange.step, Probe::HandOver::Done);
    EXPECT_EQ(exchange.conflicts(), 0);
}

TEST(HandOver, DoesNotHappenWhereTheNewOneFaults) {
    ControllerExchange exchange{{"/a", "/a"}};
    exchange.controllers[1]->onStartingUp = [](Probe& self, const Tick&) {
        self.fault(3, "no way");
        return false;
    };
    exchange.start({0});

    exchange.want({1});
    exchange.run(50);

    EXPECT_EQ(exchange.step, Probe::HandOver::Failed);
    EXPECT_EQ(exchange.state(0), State::Active);
    EXPECT_EQ(exchange.executed, std::vector<double>(50, 1));
}

TEST(HandOver, DoesNotHappenWhereTheNewOneIsNotInTimeAndTheOldOneGoesOnUntilThen) {
    ControllerExchange exchange{{"/a", "/a"}};
    exchange.controllers[1]->onStartingUp = [](Probe&, const Tick&) { return false; };
    exchange.start({0});

    exchange.want({1});
    exchange.run(5);
    EXPECT_EQ(exchange.step, Probe::HandOver::Starting);
    exchange.run(10'100);  // transitionTimeout

    EXPECT_EQ(exchange.step, Probe::HandOver::Failed);
    EXPECT_EQ(exchange.state(1), State::Fault);
    EXPECT_EQ(std::ranges::count(exchange.executed, 1), std::ssize(exchange.executed));
}

TEST(HandOver, AsksARefusedOneAgainEachHalfASecond) {
    ControllerExchange exchange{{"/a", "/a"}};
    Probe& second = *exchange.controllers[1];
    Simplex& observation = exchange.cluster.tree.add("/o", "Observation");
    exchange.cluster.tree.relate(second, "observed", observation);
    exchange.cluster.tree.relate(second, "demand", exchange.cluster.tree.add("/d", "Demand"));
    exchange.start({0});
    observation.slot().quality = Quality::Bad;

    exchange.want({1});
    exchange.run(1'020);

    EXPECT_EQ(exchange.step, Probe::HandOver::Failed);
    EXPECT_EQ(exchange.state(0), State::Active);
    EXPECT_EQ(std::ranges::count(exchange.executed, 1), std::ssize(exchange.executed));
    const auto events = exchange.cluster.events();
    EXPECT_EQ(
        std::ranges::count(events, "/c2: startup needs a good observation of what /d demands"), 3);

    observation.slot().quality = Quality::Good;
    exchange.run(500);
    EXPECT_EQ(exchange.step, Probe::HandOver::Done);
    EXPECT_EQ(exchange.state(0), State::Standby);
}

TEST(HandOver, ShutsAGroupDownAgainOfWhichOneDoesNotStart) {
    ControllerExchange exchange{{"/a", "/b", "/a", "/b"}};
    exchange.controllers[3]->onStartingUp = [](Probe& self, const Tick& tick) {
        if (tick.nominalTime > 30'000'000) self.fault(3, "no way");
        return false;
    };
    exchange.start({0, 1});

    exchange.want({2, 3});
    exchange.run(50);

    EXPECT_EQ(exchange.step, Probe::HandOver::Failed);
    EXPECT_EQ(exchange.state(0), State::Active);
    EXPECT_EQ(exchange.state(1), State::Active);
    EXPECT_EQ(exchange.state(2), State::Standby);
    EXPECT_EQ(exchange.state(3), State::Fault);
    EXPECT_EQ(exchange.executed.back(), 1);
    EXPECT_EQ(exchange.conflicts(), 0);
}

TEST(HandOver, OfGroupsLeavesEachDemandAControllerInEveryCycle) {
    ControllerExchange exchange{{"/a", "/b", "/a", "/b"}};
    exchange.controllers[3]->onStartingUp = [count = 0](Probe&, const Tick&) mutable {
        return ++count > 5;
    };
    exchange.start({0, 1});

    exchange.want({2, 3});
    exchange.run(20);

    EXPECT_GE(std::ranges::min(exchange.activeCount), 2U);
    EXPECT_EQ(exchange.step, Probe::HandOver::Done);
    EXPECT_EQ(exchange.state(0), State::Standby);
    EXPECT_EQ(exchange.cluster.number("/a", "value"), 3);
    EXPECT_EQ(exchange.cluster.number("/b", "value"), 4);
    EXPECT_EQ(exchange.conflicts(), 0);
}

TEST(HandOver, OfTwoThatBecomeActiveTogetherGoesToTheFirstInCanonicalOrder) {
    ControllerExchange exchange{{"/a", "/a"}};
    exchange.start({0, 1});

    EXPECT_EQ(exchange.state(1), State::Active);
    exchange.run(1);
    EXPECT_EQ(exchange.executed.back(), 1);
    EXPECT_EQ(exchange.conflicts(), 0);
}

TEST(HandOver, IsRefusedAtTheStartWhereAnotherWriterHasNoOrAnotherManager) {
    for (const bool other : {false, true}) {
        ControllerExchange exchange{{"/a", "/a"}};
        Probe& stranger = exchange.cluster.probe("/z");
        exchange.cluster.tree.relate(stranger, "out", exchange.cluster.tree.at("/a"));
        Probe::LifeCycleSender strangers;
        Probe& manager = exchange.cluster.probe("/other");
        exchange.cluster.tree.relate(manager, "after", stranger);
        manager.onPopulate = [&](Probe& self) {
            strangers = self.lifeCycle(self.output("after"), other);
        };
        try {
            exchange.cluster.start();
            ADD_FAILURE() << "it starts";
        } catch (const ModelError& refused) {
            ASSERT_EQ(refused.report().findings.size(), 1U) << refused.what();
            const Finding& finding = refused.report().findings.front();
            EXPECT_EQ(finding.rule, "two-managers");
            EXPECT_EQ(finding.path, "/a");
            EXPECT_EQ(finding.message, std::string{"it is written by /c1, which /manager manages, "
                                                   "and by /z, which "} +
                                           (other ? "/other" : "nobody") +
                                           " manages: both could have it at once");
        }
    }
}

TEST(HandOver, IsRefusedInWordsWhereOneIsNotManaged) {
    ControllerExchange exchange{{"/a", "/a"}};
    exchange.manager.onPopulate = [&](Probe& self) {
        for (const OutputSimplex& each : self.outputs("after"))
            exchange.choices.push_back(self.lifeCycle(each));
    };
    exchange.cluster.start();
    exchange.cluster.startup(exchange.manager);
    exchange.run(2);

    EXPECT_EQ(exchange.cluster.state("/manager"), State::Fault);
    EXPECT_TRUE(exchange.cluster.hasEvent(
        "/manager: fault -1: /c1 is not managed by the simplex that hands it over"));
}

// Each controller goes on from where the demand is, and moves with all the speed that it may have.
struct MovingExchange : ControllerExchange {
    static constexpr double speed = 2;  // rad/s, the rate of SharedDemand.position
    std::vector<double> positions;

    explicit MovingExchange(std::uint32_t threads)
        : ControllerExchange{{}, threads, "SharedSignal"} {
        Simplex& demand = cluster.tree.add("/d", "SharedDemand");
        Simplex& observation = cluster.tree.add("/o", "Observation");
        cluster.tree.relate(drive, "in", demand);
        for (const char* path : {"/m1", "/m2", "/m3"}) {
            Probe& controller = cluster.probe(path);
            cluster.tree.relate(controller, "observed", observation);
            cluster.tree.relate(controller, "demand", demand);
            cluster.tree.relate(manager, "after", controller);
            move(controller, controllers.size());
            controllers.push_back(&controller);
        }
        wanted.resize(controllers.size());
        drive.onPopulate = [this](Probe& self) {
            self.onLoopEnd = [this, at = self.inputs("in")[1].data<double>("position")](
                                 Probe&, const Tick&) { positions.push_back(at); };
        };
    }

    static void move(Probe& controller, std::size_t number) {
        controller.onPopulate = [number](Probe& self) {
            const auto accepted = self.output("demand").accepted<double>("position");
            auto position = self.output("demand").data<double>("position");
            auto before = std::make_shared<double>(0);
            self.onStartingUp = [before, calls = number](Probe&, const Tick&) mutable {
                *before = -1;
                return ++calls % 3 == 0;
            };
            self.onActive = [=](Probe&, const Tick& tick) mutable {
                if (*before < 0) {  // the first cycle
                    position = accepted;
                    *before = 1;
                }
                const double way = speed * (number == 1 ? -0.5 : 0.5);
                position = std::clamp(position + way * tick.elapsedSeconds(), -3.0, 3.0);
            };
        };
    }
};

class RandomHandOvers : public testing::TestWithParam<std::uint32_t> {};

// Also such that come before the one before them is over, and back to the one that was just left.
TEST_P(RandomHandOvers, NeverStepTheDemand) {
    MovingExchange moving{GetParam()};
    moving.start({0});
    std::minstd_rand chance{7};
    std::size_t exchanges = 0;
    while (exchanges < 1000) {
        moving.want({chance() % 3});
        moving.run(1 + static_cast<int>(chance() % 9));
        ++exchanges;
    }

    double longest = 0;
    for (std::size_t i = 1; i < moving.positions.size(); ++i) {
        longest = std::max(longest, std::abs(moving.positions[i] - moving.positions[i - 1]));
    }
    EXPECT_LE(longest, MovingExchange::speed / 2 * 1e-3 * (1 + 1e-9)) << "no limiter was needed";
    EXPECT_GT(longest, 0);
    EXPECT_GE(std::ranges::min(moving.activeCount), 1U);
    EXPECT_EQ(moving.conflicts(), 0);
    EXPECT_EQ(moving.cluster.integer("/test", "limitCount"), 0);
}

INSTANTIATE_TEST_SUITE_P(Threads, RandomHandOvers, testing::Values(1U, 2U, 4U));

}  // namespace

}  // namespace cortex::test
