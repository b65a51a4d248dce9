// SPDX-License-Identifier: Apache-2.0
// Controllers of three axes are exchanged while the axes move. Judged by the demands that went out.
#include "cortex/core/error.hpp"
#include "cortex/core/registry.hpp"
#include "cortex/cs/cluster_cs.hpp"
#include "cortex/cs/testing.hpp"
#include "cortex/toolkit/classes.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

constexpr std::size_t axes = 3;
constexpr double period = 1e-3;
constexpr double speed = 2, acceleration = 10, jerk = 100;  // of LimitedAxis

int exchanges() {
    const char* asked = std::getenv("CORTEX_EXCHANGES");
    return asked ? std::atoi(asked) : 50;
}

struct Demand {
    double position = 0, velocity = 0, acceleration = 0;
    bool operator==(const Demand&) const = default;
};
using Demands = std::array<Demand, axes>;

class ExchangedControllers {
public:
    explicit ExchangedControllers(std::uint32_t threads) : cluster_{"arm", {.threads = threads}} {
        addClasses(registry_);
        cs::ClusterTesting::set(cluster_, {.forceThreads = true, .chunkSize = 1});
        Report report;
        tree_.add(system(), &registry_, report);
        if (!report.ok()) throw ModelError(std::move(report));
        cluster_.addSimplexTree(tree_);
        trigger_ = &cluster_.setTriggerSource<cs::ManualTrigger>(std::chrono::milliseconds{1});
        cluster_.start();
        send("/arm", "startup", {{"prefix", std::string{"/"}}});
        for (int i = 0; i < 20; ++i) trigger_->step();
        last_ = demands();
    }

    // So many exchanges: random commands to the controllers and, after up to 80 cycles each, or
    // 400, to the selector.
    void run(int count) {
        for (int i = 0; switched_ < count && i < 2 * count; ++i) {
            const int cycles = static_cast<int>(between(1, i % 8 == 0 ? 400 : 80));
            for (int cycle = 0; cycle < cycles; ++cycle) {
                command();
                step();
            }
            group_ = 1 + (group_ + static_cast<std::int64_t>(between(0, 3.999))) % 5;
            send("/selector", "select", {{"group", group_}});
        }
    }
    void command() {
        const double chance = between(0, 1);
        if (chance < 0.03) {
            std::vector<double> pose(16);
            for (double& each : pose) each = between(-2.9, 2.9);
            send("/pose", "set", {{"pose", pose}});
            send("/pose", "moveTo", {{"speedShare", between(0.1, 1)}});
        } else if (chance < 0.04) {
            send("/points", "teach", {});
        } else if (chance < 0.05) {
            send("/points", "run", {{"from", std::int64_t{1}}});
        } else if (chance < 0.08) {
            send("/tip", "jog", {{"angular", std::vector{0.0, 0.0, between(-0.5, 0.5)}}});
        } else if (chance < 0.1) {
            send("/jog", "jog",
                 {{"axis", static_cast<std::int64_t>(between(1, axes + 0.999))},
                  {"velocity", between(-speed, speed)}});
        }
    }
    void step() {
        trigger_->step();
        const Demands now = demands();
        for (std::size_t i = 0; i < axes; ++i) judge(last_[i], now[i]);
        const auto switched = get<std::int64_t>("/selector", "switchCount");
        if (switched != switched_) {
            switched_ = switched;
            inMotion_ += std::ranges::any_of(
                last_, [](const Demand& each) { return std::abs(each.velocity) > 0.01; });
        }
        history.push_back(now);
        last_ = now;
    }
    template <class T>
    T get(const std::string& path, const std::string& item) {
        return cluster_.image().get<T>(path, item);
    }
    std::int64_t switched() const { return switched_; }
    int inMotion() const { return inMotion_; }

    // Greatest changes in one cycle, as shares of what the limits allow.
    Demand used;
    std::vector<Demands> history;

private:
    static SystemDescription system() {
        SystemDescription system;
        const auto add = [&](const std::string& path, const std::string& type,
                             const std::vector<std::pair<std::string, std::string>>& relates) {
            SystemDescription::SimplexEntry entry;
            entry.path = path;
            entry.type = type;
            for (const auto& [rule, to] : relates)
                entry.relates.push_back({rule, to, false, false, {}});
            system.simplexes.push_back(entry);
        };
        std::vector<std::pair<std::string, std::string>> both;
        for (std::size_t i = 1; i <= axes; ++i) {
            const std::string number = std::to_string(i);
            const std::string demand = "/demand" + number, axis = "/axis" + number;
            add(demand, "LimitedAxis", {});
            add(axis, "RotaryAxisObservation", {});
            add("/drive" + number, "SimulatedAxis", {{"demand", demand}, {"observation", axis}});
            both.emplace_back("axes", axis);
            both.emplace_back("demands", demand);
        }
        add("/pose", "AxisPoseController", both);
        add("/jog", "JogController", both);
        add("/hold", "HoldAxisController", both);
        add("/points", "JointTrajectoryController", both);
        add("/tip", "CartesianJogController", both);
        // Three axes about one line, so that only a turn about it counts.
        system.simplexes.back().settings.push_back(
            {"directions", "false false false false false true", {}, false});
        add("/selector", "AxisControllerSelector",
            {{"choices", "/pose"},
             {"choices", "/jog"},
             {"choices", "/hold"},
             {"choices", "/points"},
             {"choices", "/tip"}});
        return system;
    }
    void send(const std::string& path, const std::string& name,
              const ProgramInterface::Arguments& arguments) {
        cluster_.send(path, name, arguments);
    }
    Demands demands() {
        Demands all;
        for (std::size_t i = 0; i < axes; ++i) {
            const std::string path = "/demand" + std::to_string(i + 1);
            all[i] = {get<double>(path, "position"), get<double>(path, "velocity"),
                      get<double>(path, "acceleration")};
        }
        return all;
    }
    void judge(const Demand& before, const Demand& now) {
        const auto include = [](double& most, double change, double limit) {
            most = std::max(most, std::abs(change) / (limit * period));
        };
        include(used.position, now.position - before.position, speed);
        include(used.velocity, now.velocity - before.velocity, acceleration);
        include(used.acceleration, now.acceleration - before.acceleration, jerk);
    }
    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }

    ClassRegistry registry_;
    SimplexTree tree_{TypeModel::load(
        std::vector<std::filesystem::path>{CORTEX_SOURCE_DIR "/ontology/robotics-morphology.xml",
                                           CORTEX_SOURCE_DIR "/tests/data/limited-axes.xml"})};
    cs::ClusterCS cluster_;
    cs::ManualTrigger* trigger_ = nullptr;
    std::mt19937_64 engine_{11};
    Demands last_;
    std::int64_t group_ = 1, switched_ = 0;
    int inMotion_ = 0;
};

class Exchanges : public testing::TestWithParam<std::uint32_t> {};

TEST_P(Exchanges, InMotionKeepTheLimitsInEveryCycle) {
    ExchangedControllers plant{GetParam()};

    plant.run(exchanges());

    std::cout << plant.history.size() << " cycles, " << plant.switched() << " exchanges, "
              << plant.inMotion() << " in motion; used of V " << plant.used.position << ", of A "
              << plant.used.velocity << ", of J " << plant.used.acceleration << '\n';
    EXPECT_LE(plant.used.position, 1 + 1e-9);
    EXPECT_LE(plant.used.velocity, 1 + 1e-9);
    EXPECT_LE(plant.used.acceleration, 1 + 1e-9);
    EXPECT_GT(plant.used.acceleration, 0.99);
    EXPECT_GT(plant.inMotion(), exchanges() / 4);
    EXPECT_EQ(plant.get<std::int64_t>("/arm", "conflictCount"), 0);
    EXPECT_EQ(plant.get<std::int64_t>("/arm", "limitCount"), 0);
}

INSTANTIATE_TEST_SUITE_P(OfThreads, Exchanges, testing::Values(1U, 2U, 4U),
                         testing::PrintToStringParamName());

TEST(ExchangesOfControllers, AreTheSameOnAnyNumberOfThreads) {
    ExchangedControllers one{1}, four{4};
    for (ExchangedControllers* plant : {&one, &four}) plant->run(10);

    EXPECT_EQ(one.history, four.history);
}

}  // namespace
}  // namespace cortex::toolkit::test
