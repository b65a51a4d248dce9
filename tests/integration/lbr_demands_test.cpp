// SPDX-License-Identifier: Apache-2.0
// For each way out of Active, and back: no demand of the case study steps by more than its axis may
// move in a cycle.
#include "cortex/cs/testing.hpp"

#include "mechanics/lbr_chain.hpp"
#include "teleop.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

constexpr const char* types = R"(
    <type name="TestFollow" extends="FollowAxisController" description="Fails when it is told to."/>
    <type name="TestDrive" extends="SimulatedAxis" description="Loses its sensor when told to."/>)";

class TestFollow final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;
    enum Mode { Good, Faults, Throws, WritesNan, Jumps };
    std::atomic<int> mode{Good};

private:
    void populate() override {
        for (const auto& target : inputs("targets")) {
            targets_.push_back(target.data<double>("position"));
        }
        for (const auto& demand : outputs("demands")) {
            demands_.push_back(demand.data<double>("position"));
        }
    }
    void stateActive(const Tick&) override {
        for (std::size_t i = 0; i < targets_.size(); ++i) demands_[i] = targets_[i];
        if (mode == Good) return;
        for (std::size_t i = 0; i < 4; ++i) demands_[i] += 1.0;  // half written, and wildly
        if (mode == Faults) fault(1, "the test wants it");
        if (mode == Throws) throw std::runtime_error("the test wants it");
        if (mode == WritesNan) demands_[2] = std::numeric_limits<double>::quiet_NaN();
    }

    std::vector<Data<const double>> targets_;
    std::vector<Data<double>> demands_;
};

class TestDrive final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;
    std::atomic<bool> blind{false};

private:
    void populate() override {
        demand_ = input("demand").data<double>("position");
        position_ = output("observation").data<double>("position");
        position_ = data<const double>("startPosition").get();
    }
    void loopEnd(const Tick& tick) override {
        const double reach = 1.3 * tick.elapsedSeconds();
        if (state() == State::Active) position_ += std::clamp(demand_ - position_, -reach, reach);
        if (blind) setQuality(Quality::Lost);
    }

    Data<const double> demand_;
    Data<double> position_;
};

// The largest step of any demand, as a share of what its axis may move in that time.
class StepWatch {
public:
    void operator()(const Image& image) {
        const Axes now = positionsOf(image, "demands");
        const double seconds = static_cast<double>(image.nominalTime() - lastTime_) * 1e-9;
        if (lastTime_ >= 0) {
            for (std::size_t i = 0; i < lbrAxes; ++i) {
                const double allowed = joints_[i].maxSpeed * seconds;
                worst = std::max(worst, std::abs(now[i] - last_[i]) / allowed);
                way += std::abs(now[i] - last_[i]);
            }
        }
        last_ = now;
        lastTime_ = image.nominalTime();
    }
    double worst = 0, way = 0;

private:
    std::vector<mechanics::ChainJoint> joints_ = mechanics::test::lbrJoints();
    Axes last_{};
    std::int64_t lastTime_ = -1;
};

struct WayOut {
    const char* name;
    std::function<void(Teleop&)> out, back;
    cs::Overflow overflow = cs::Overflow::Skip;
};

TestFollow& follow(Teleop& teleop) {
    return dynamic_cast<TestFollow&>(teleop.tree.at("/control/follow"));
}

TestDrive& drive(Teleop& teleop) { return dynamic_cast<TestDrive&>(teleop.tree.at("/drives/4")); }

std::function<void(Teleop&)> mode(TestFollow::Mode mode) {
    return [mode](Teleop& teleop) {
        follow(teleop).mode = mode;
        teleop.step(5);
        EXPECT_EQ(stateOf(teleop.image(), "/control/follow"), State::Fault);
        teleop.step(700);
        EXPECT_EQ(stateOf(teleop.image(), "/control/hold"), State::Active);
    };
}

void clearFollow(Teleop& teleop) {
    follow(teleop).mode = TestFollow::Good;
    EXPECT_TRUE(teleop.call("/control/follow", "clearFaults", "").done());
}

void shutDown(Teleop& teleop) {
    EXPECT_TRUE(teleop.call("/teleop", "shutdown", "/").done());
    EXPECT_EQ(stateOf(teleop.image(), "/control/follow"), State::Standby);
    teleop.step(700);
}

void halt(Teleop& teleop) {
    cs::ClusterTesting::playLate(*teleop.trigger, 3);
    teleop.step(3);
    EXPECT_EQ(stateOf(teleop.image(), "/control/follow"), State::Fault);
    EXPECT_EQ(stateOf(teleop.image(), "/drives/1"), State::Fault);
    teleop.step(700);
}

void restart(Teleop& teleop) {
    EXPECT_TRUE(teleop.call("/teleop", "clearFaults", "/").done());
    teleop.startUp();
}

void loseAxis(Teleop& teleop) {
    drive(teleop).blind = true;
    teleop.step(5);
    EXPECT_EQ(teleop.image().quality("/arm/lbr/axes/4"), Quality::Lost);
    EXPECT_GE(teleop.image().quality("/control/forward/tip"), Quality::Bad);
    const Axes before = positionsOf(teleop.image(), "demands");
    teleop.step(700);
    const Axes after = positionsOf(teleop.image(), "demands");
    for (std::size_t i = 0; i < lbrAxes; ++i) EXPECT_NEAR(after[i], before[i], 0.05);
}

void findAxis(Teleop& teleop) { drive(teleop).blind = false; }

const WayOut WaysOut[] = {
    {"Shutdown", shutDown, [](Teleop& teleop) { teleop.startUp(); }},
    {"Fault", mode(TestFollow::Faults), clearFollow},
    {"Throw", mode(TestFollow::Throws), clearFollow},
    {"NotANumber", mode(TestFollow::WritesNan), clearFollow},
    {"Halt", halt, restart, cs::Overflow::Halt},
    {"LostInput", loseAxis, findAxis},
};

class Demands : public testing::TestWithParam<WayOut> {};

Teleop::Set setOf(cs::Overflow overflow, StepWatch& watch) {
    Teleop::Set set;
    set.ontology = types;
    set.replacements = {
        {"type=\"FollowAxisController\"", "type=\"TestFollow\""},
        {"path=\"/drives/4\" type=\"SimulatedAxis\"", "path=\"/drives/4\" type=\"TestDrive\""}};
    set.classes = [](ClassRegistry& registry) {
        registry.add<TestFollow>("TestFollow");
        registry.add<TestDrive>("TestDrive");
    };
    set.options.overflow = overflow;
    set.watch = [&watch](const Image& image) { watch(image); };
    return set;
}

TEST_P(Demands, NeverStepOnTheWayOutAndBack) {
    StepWatch watch;
    Teleop teleop{setOf(GetParam().overflow, watch)};
    teleop.startUp();
    teleop.runUntil(4);
    ASSERT_EQ(stateOf(teleop.image(), "/control/follow"), State::Active);

    GetParam().out(teleop);
    GetParam().back(teleop);
    teleop.runUntil(10.2);

    EXPECT_EQ(stateOf(teleop.image(), "/control/follow"), State::Active);
    EXPECT_LE(watch.worst, 1 + 1e-9);
    EXPECT_GT(watch.way, 1);
}

INSTANTIATE_TEST_SUITE_P(Lbr, Demands, testing::ValuesIn(WaysOut),
                         [](const auto& test) { return std::string{test.param.name}; });

TEST(LbrDemands, NeverStepWhenTheAgentStops) {
    StepWatch watch;
    Teleop teleop{setOf(cs::Overflow::Skip, watch)};
    teleop.startUp();
    teleop.runUntil(4);

    EXPECT_TRUE(teleop.cluster->stop());

    EXPECT_EQ(stateOf(teleop.image(), "/control/follow"), State::Standby);
    EXPECT_EQ(teleop.image().get<double>("/arm/lbr/demands/1", "velocity"), 0);
    EXPECT_LE(watch.worst, 1 + 1e-9);
}

TEST(LbrDemands, WildDemandsAreRampedAndStayInTheRange) {
    StepWatch watch;
    Teleop teleop{setOf(cs::Overflow::Skip, watch)};
    teleop.startUp();
    teleop.runUntil(4);

    follow(teleop).mode = TestFollow::Jumps;
    teleop.step(400);

    EXPECT_EQ(stateOf(teleop.image(), "/control/follow"), State::Active);
    EXPECT_LE(watch.worst, 1 + 1e-9);
    EXPECT_GT(watch.worst, 0.99);
    EXPECT_GT(teleop.image().get<std::int64_t>("/teleop", "limitCount"), 0);
}

}  // namespace
}  // namespace cortex::test
