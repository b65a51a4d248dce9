// SPDX-License-Identifier: Apache-2.0
// What is safe="stop": a demand in motion slows down by its rate, and never contradicts itself.
#include "cortex/cs/testing.hpp"

#include "support/probe.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

constexpr double cycleTime = 1e-3;                     // s, of the manual trigger
constexpr double range = 3, speed = 2, braking = 200;  // of StoppedAxis: rad, rad/s, rad/s2
constexpr std::size_t axes = 3;                        // of one demand
constexpr double rounding = 1e-12;

struct Now {
    double position = 0, velocity = 0;
};
using Nows = std::array<Now, axes>;

// A controller of three axes, with a guard that it cannot do without; and where it shares the
// demand, another that never starts.
struct Arm {
    Probe *guard = nullptr, *controller = nullptr;
    std::string path;
    std::array<double, axes> position{}, velocity{};  // written in Active
    bool faults = false;

    Arm(ProbeCluster& cluster, const std::string& name, bool shared,
        const std::vector<double>& start = {0.5, -0.5, 1})
        : path{"/demand" + name} {
        guard = &cluster.probe("/guard" + name);
        controller = &cluster.probe("/arm" + name);
        Simplex& signal = cluster.tree.add("/signal" + name, "Signal");
        Simplex& demand = cluster.tree.add(path, shared ? "SharedStoppedAxis" : "StoppedAxis");
        Simplex& seen = cluster.tree.add("/seen" + name, "StoppedObservation");
        seen.set("position", start);
        cluster.tree.relate(*guard, "out", signal);
        cluster.tree.relate(*controller, "guarded", signal);
        join(cluster, *controller, demand, seen);
        if (shared) join(cluster, cluster.probe("/other" + name), demand, seen);
        controller->onPopulate = [this](Probe& self) {
            const auto positions = self.output("axis").array<double>("position");
            const auto velocities = self.output("axis").array<double>("velocity");
            self.onActive = [this, positions, velocities](Probe& probe, const Tick&) {
                std::ranges::copy(position, positions.begin());
                std::ranges::copy(velocity, velocities.begin());
                if (faults) probe.fault(3, "asked for");
            };
        };
    }
    static void join(ProbeCluster& cluster, Probe& writer, Simplex& demand, Simplex& seen) {
        cluster.tree.relate(writer, "stands", seen);
        cluster.tree.relate(writer, "axis", demand);
    }
    Nows now(const Image& image) const {
        const Structure& structure = image.structure();
        const std::uint32_t simplex = structure.find(path);
        const auto values = [&](const char* item) {
            const ItemLayout* layout = structure.simplexes[simplex].layout->find(item);
            return std::get<std::vector<double>>(image.value(simplex, *layout));
        };
        const std::vector<double> positions = values("position"), velocities = values("velocity");
        Nows all;
        for (std::size_t i = 0; i < axes; ++i) all[i] = {positions[i], velocities[i]};
        return all;
    }
    Nows now(ProbeCluster& cluster) const { return now(cluster.cluster->image()); }
};

// "" or how the second contradicts the first, one cycle before it.
std::string contradiction(const Now& before, const Now& now) {
    const double mean = (before.velocity + now.velocity) / 2;
    const bool atItsEnd = std::abs(now.position) == range;
    const double way = now.position - before.position;
    const auto text = [&](const char* what) {
        return std::string{what} + ": " + std::to_string(before.position) + " at " +
               std::to_string(before.velocity) + ", then " + std::to_string(now.position) + " at " +
               std::to_string(now.velocity);
    };
    if (std::abs(now.position) > range) return text("out of range");
    if (std::abs(way) > speed * cycleTime + rounding) return text("too fast");
    if (atItsEnd && now.velocity == 0) return "";
    const double moving =  // less than a cycle where it comes to rest within
        now.velocity == 0 ? std::min(cycleTime, std::abs(before.velocity) / braking) : cycleTime;
    if (std::abs(way - mean * moving) > rounding) return text("no derivative");
    if (std::abs(now.velocity) > std::abs(before.velocity)) return text("faster");
    if (now.velocity * before.velocity < 0) return text("backwards");
    const double change = std::abs(now.velocity - before.velocity);
    if (change > braking * cycleTime + rounding) return text("slows down too fast");
    return "";
}

class Arms {
public:
    explicit Arms(std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            starts_.push_back({at(range), at(range), at(range)});
            arms_.push_back(
                std::make_unique<Arm>(cluster_, std::to_string(i), i % 2 == 1, starts_.back()));
        }
        cluster_.start();
        for (const auto& arm : arms_) {
            cluster_.cluster->send(arm->guard->path(), "startup");
        }
        cluster_.step(3);
    }

    // All in motion, each somewhere, and each leaves Active in one of three ways.
    void leave() {
        for (std::size_t n = 0; n < arms_.size(); ++n) {
            cluster_.cluster->send(arms_[n]->controller->path(), "startup");
            for (std::size_t i = 0; i < axes; ++i) {
                arms_[n]->position[i] = std::clamp(starts_[n][i] + at(0.3), -range, range);
                arms_[n]->velocity[i] = at(speed);
            }
        }
        cluster_.step(400);  // at most 0.6 rad take 300
        before_.clear();
        const Image image = cluster_.cluster->image();
        for (const auto& arm : arms_) {
            before_.push_back(arm->now(image));
            const int way = std::uniform_int_distribution{0, 2}(random_);
            if (way == 0) cluster_.cluster->send(arm->controller->path(), "shutdown");
            if (way == 1) arm->faults = true;
            if (way == 2) {
                arm->guard->onActive = [](Probe& self, const Tick&) {
                    self.setQuality(Quality::Bad);
                };
            }
        }
    }
    // A cycle: every contradiction goes to `found`. Whether all stand.
    bool step(std::vector<std::string>& found) {
        cluster_.step();
        bool stand = true;
        const Image image = cluster_.cluster->image();
        for (std::size_t n = 0; n < arms_.size(); ++n) {
            const Nows now = arms_[n]->now(image);
            for (std::size_t i = 0; i < axes; ++i) {
                const std::string wrong = contradiction(before_[n][i], now[i]);
                if (!wrong.empty()) found.push_back(arms_[n]->path + " " + wrong);
                stand = stand && now[i].velocity == 0;
            }
            before_[n] = now;
        }
        return stand;
    }
    void recover() {
        for (const auto& arm : arms_) {
            arm->faults = false;
            arm->guard->onActive = nullptr;
            cluster_.cluster->send(arm->controller->path(), "shutdown");
        }
        cluster_.step(3);
        for (const auto& arm : arms_)
            cluster_.cluster->send(arm->controller->path(), "clearFaults");
        cluster_.step(3);
    }
    std::size_t exits() const { return arms_.size() * axes; }

private:
    double at(double greatest) {
        // Now and then where a range ends: that is where it is difficult.
        const double share = std::uniform_real_distribution{-1.2, 1.2}(random_);
        return std::clamp(share, -1.0, 1.0) * greatest;
    }

    std::mt19937 random_{40};
    ProbeCluster cluster_;
    std::vector<std::vector<double>> starts_;  // of each arm: a way on from it is short
    std::vector<std::unique_ptr<Arm>> arms_;
    std::vector<Nows> before_;
};

TEST(WhatStops, NeverContradictsItselfOnRandomWaysOutOfActive) {
#ifdef CORTEX_UNDER_SANITIZER
    constexpr std::size_t least = 500;
#else
    constexpr std::size_t least = 10'000;
#endif
    Arms arms{100};
    std::vector<std::string> found;
    std::size_t exits = 0;
    while (exits < least) {
        arms.leave();
        int cycles = 0;
        bool stand = false;
        // Two to react, then ten from the greatest speed, and one in which it stands.
        while (!stand && cycles < 20) {
            stand = arms.step(found);
            ++cycles;
        }
        ASSERT_TRUE(stand) << "in motion after " << cycles << " cycles";
        ASSERT_TRUE(found.empty()) << found.size() << " contradictions, first: " << found.front();
        exits += arms.exits();
        arms.recover();
    }
    std::cout << exits << " exits\n";
}

TEST(WhatStops, BeginsWhereItIsObservedAndAtRest) {
    ProbeCluster cluster;
    Arm arm{cluster, "", false};
    bool starting = false;
    arm.controller->onStartingUp = [&](Probe&, const Tick&) { return !starting; };
    cluster.start();
    EXPECT_EQ(arm.now(cluster)[0].position, 0.5) << "before the first start";
    cluster.startup(*arm.guard);
    arm.position = {1, 1, 1};
    arm.velocity = {1, 1, 1};
    cluster.startup(*arm.controller);
    cluster.step(1000);
    cluster.call(arm.controller->path(), "shutdown");
    cluster.step(100);
    EXPECT_GT(arm.now(cluster)[0].position, 1) << "it has stopped where it came to";

    starting = true;
    cluster.cluster->send(arm.controller->path(), "startup");
    cluster.step(1000);

    EXPECT_EQ(cluster.state(arm.controller->path()), State::StartingUp);
    EXPECT_EQ(arm.now(cluster)[0].position, 0.5);
    EXPECT_EQ(arm.now(cluster)[1].position, -0.5);
    EXPECT_EQ(arm.now(cluster)[0].velocity, 0);
}

TEST(WhatStops, ComesToRestInAStartupToo) {
    for (const bool shared : {false, true}) {
        ProbeCluster cluster;
        Arm arm{cluster, "", shared};
        bool starting = false;
        arm.controller->onStartingUp = [&](Probe&, const Tick&) { return !starting; };
        cluster.start();
        cluster.startup(*arm.guard);
        arm.position = {1, 1, 1};
        arm.velocity = {2, -1.5, 0.5};
        cluster.startup(*arm.controller);
        cluster.step(1000);
        cluster.cluster->send(arm.controller->path(), "shutdown");
        cluster.step(2);
        starting = true;
        cluster.cluster->send(arm.controller->path(), "startup");
        Nows before = arm.now(cluster);
        ASSERT_GT(before[0].velocity, 1) << shared;
        while (before[0].velocity != 0) {
            cluster.step();
            const Nows now = arm.now(cluster);
            for (std::size_t i = 0; i < axes; ++i)
                EXPECT_EQ(contradiction(before[i], now[i]), "") << shared;
            before = now;
        }
        cluster.step(1000);

        EXPECT_EQ(cluster.state(arm.controller->path()), State::StartingUp);
        EXPECT_EQ(arm.now(cluster)[0].position, 0.5) << "then it begins where it is observed";
        EXPECT_EQ(arm.now(cluster)[1].position, -0.5) << shared;
    }
}

// The loop stood still for longer than it takes to brake, as of a debugger or an overloaded host.
TEST(WhatStops, MakesTheWayOfThreeCyclesHoweverLateItsNextOneComes) {
    ProbeCluster cluster;
    Arm arm{cluster, "", false};
    cluster.start();
    cluster.startup(*arm.guard);
    arm.position = {1, 1, 1};
    arm.velocity = {2, -2, 0.5};
    cluster.startup(*arm.controller);
    cluster.step(1000);
    arm.faults = true;
    cs::ClusterTesting::playLate(*cluster.trigger, 50);  // of the tick after the next
    cluster.step();
    const Nows moving = arm.now(cluster);
    ASSERT_GT(moving[0].velocity, 1) << "it has begun to brake";

    cluster.step();

    const Nows later = arm.now(cluster);
    for (std::size_t i = 0; i < axes; ++i) {
        const double time = 3 * cycleTime, v = moving[i].velocity;
        const double after = std::copysign(std::max(0.0, std::abs(v) - braking * time), v);
        const double moves = std::min(time, std::abs(v) / braking);
        EXPECT_NEAR(later[i].velocity, after, rounding);
        EXPECT_NEAR(later[i].position, moving[i].position + (v + after) / 2 * moves, rounding);
    }
}

TEST(WhatStops, EndsBeforeTheClusterEnds) {
    ProbeCluster cluster{{.threads = 1}};
    Arm arm{cluster, "", false};
    cluster.start();
    cluster.startup(*arm.guard);
    arm.position = {1, 1, 1};
    arm.velocity = {2, -2, 0.5};
    cluster.startup(*arm.controller);
    cluster.step(1000);

    EXPECT_TRUE(cluster.cluster->stop());

    const Nows stopped = arm.now(cluster);
    EXPECT_EQ(stopped[0].velocity, 0);
    EXPECT_EQ(stopped[1].velocity, 0);
    EXPECT_NEAR(stopped[0].position, 1 + 2 * 2 / (2 * braking), 2 * speed * cycleTime);
    EXPECT_NEAR(stopped[1].position, 1 - 2 * 2 / (2 * braking), 2 * speed * cycleTime);
}

}  // namespace
}  // namespace cortex::test
