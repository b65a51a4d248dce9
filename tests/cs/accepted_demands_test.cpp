// SPDX-License-Identifier: Apache-2.0
// What a writer reads of a demand: the value that went out in the cycle before, whoever wrote it.
#include "cortex/core/error.hpp"
#include "cortex/cs/testing.hpp"

#include "support/probe.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {

namespace {

// One or two controllers of one demand, and the device that executes it.
struct AcceptedAxis {
    static constexpr double step =
        0.002;  // rad, which the rate of Demand.position allows in a cycle

    ProbeCluster cluster;
    Probe& first = cluster.probe("/first");
    Probe* second = nullptr;
    Probe& drive = cluster.tree.add<Probe>("/drive", "Probe");
    struct Writer {
        double wanted = 0;
        std::vector<double> accepted;  // at the begin of each cycle
        std::vector<double> after;     // and when its hooks had written
    };
    Writer one, two;
    std::vector<double> executed;  // by the device, in each cycle

    AcceptedAxis(bool shared, std::uint32_t threads) : cluster{{.threads = threads}} {
        cs::ClusterTesting::set(*cluster.cluster, {.forceThreads = true, .chunkSize = 1});
        Simplex& demand = cluster.tree.add("/d", shared ? "SharedDemand" : "Demand");
        Simplex& observation = cluster.tree.add("/o", "Observation");
        observation.set("position", 0.25);
        join(first, one, demand, observation);
        if (shared) {
            second = &cluster.probe("/second");
            join(*second, two, demand, observation);
        }
        cluster.tree.relate(drive, "in", demand);
        cluster.tree.relate(drive, "out", observation, true);
        drive.onPopulate = [this](Probe& self) {
            self.onLoopEnd = [this, at = self.input("in").data<double>("position")](
                                 Probe&, const Tick&) { executed.push_back(at); };
        };
        cluster.start();
    }

    void join(Probe& controller, Writer& writer, Simplex& demand, Simplex& observation) {
        cluster.tree.relate(controller, "observed", observation);
        cluster.tree.relate(controller, "demand", demand);
        controller.onPopulate = [&writer](Probe& self) {
            const auto demands = self.output("demand");
            const auto accepted = demands.accepted<double>("position", "rad");
            Data<double> position = demands.data<double>("position");
            self.onLoopStart = [&writer, accepted](Probe&, const Tick&) {
                writer.accepted.push_back(accepted);
            };
            self.onActive = [&writer, position](Probe&, const Tick&) mutable {
                position = writer.wanted;
            };
            self.onLoopEnd = [&writer, accepted](Probe&, const Tick&) {
                writer.after.push_back(accepted);
            };
        };
    }

    // What a writer reads in a cycle is what the device executed in the cycle before.
    void expectAccepted(const Writer& writer) const {
        ASSERT_EQ(writer.accepted.size(), executed.size());
        for (std::size_t i = 1; i < executed.size(); ++i) {
            EXPECT_EQ(writer.accepted[i], executed[i - 1]) << "cycle " << i + 1;
        }
        EXPECT_EQ(writer.after, writer.accepted) << "it follows what is written in the cycle";
    }
};

class AcceptedDemands : public testing::TestWithParam<std::tuple<bool, std::uint32_t>> {
protected:
    bool shared() const { return std::get<0>(GetParam()); }
    std::uint32_t threads() const { return std::get<1>(GetParam()); }
};

TEST_P(AcceptedDemands, BeforeTheFirstStartAreWhatTheDeviceSees) {
    AcceptedAxis axis{shared(), threads()};

    axis.cluster.step(3);

    EXPECT_EQ(axis.one.accepted, (std::vector<double>{0.25, 0.25, 0.25}));
    EXPECT_EQ(axis.executed, axis.one.accepted);
}

TEST_P(AcceptedDemands, AreWhatTheLimiterLeft) {
    AcceptedAxis axis{shared(), threads()};
    axis.cluster.startup(axis.first);
    const double begin = axis.executed.back();
    axis.one.wanted = 10;

    axis.cluster.step(3);

    axis.expectAccepted(axis.one);
    EXPECT_NEAR(axis.executed.back(), begin + 3 * AcceptedAxis::step, 1e-12);
}

TEST_P(AcceptedDemands, AreTheSafeValueWhereThatStands) {
    AcceptedAxis axis{shared(), threads()};
    axis.cluster.startup(axis.first);
    axis.one.wanted = 10;
    axis.cluster.step(5);
    axis.cluster.call("/first", "shutdown");
    axis.cluster.step(20);

    axis.expectAccepted(axis.one);
    EXPECT_EQ(axis.one.accepted.back(), 0.25) << "observed";
    EXPECT_EQ(axis.cluster.state("/first"), State::Standby);
}

INSTANTIATE_TEST_SUITE_P(Writers, AcceptedDemands,
                         testing::Combine(testing::Bool(), testing::Values(1U, 2U, 4U)),
                         [](const auto& each) {
                             return std::string{std::get<0>(each.param) ? "Shared" : "Sole"} +
                                    std::to_string(std::get<1>(each.param)) + "Threads";
                         });

class SharedAcceptedDemands : public testing::TestWithParam<std::uint32_t> {};

TEST_P(SharedAcceptedDemands, AreWhatTheOtherWriterDemanded) {
    AcceptedAxis axis{true, GetParam()};
    axis.two.wanted = 2;
    axis.cluster.startup(*axis.second);
    axis.cluster.step(50);

    axis.expectAccepted(axis.one);
    axis.expectAccepted(axis.two);
    EXPECT_EQ(axis.cluster.state("/first"), State::Standby);
    EXPECT_GT(axis.one.accepted.back(), 0.3) << "its own safe value stands at 0.25";
}

TEST_P(SharedAcceptedDemands, AreWhereAControllerGoesOnFrom) {
    AcceptedAxis axis{true, GetParam()};
    axis.two.wanted = 2;
    axis.cluster.startup(*axis.second);
    axis.cluster.step(50);
    axis.cluster.call("/second", "shutdown");
    axis.cluster.step(5);
    axis.one.wanted = -2;
    axis.cluster.startup(axis.first);
    axis.cluster.step(5);

    axis.expectAccepted(axis.one);
    axis.expectAccepted(axis.two);
    const auto& all = axis.executed;
    for (std::size_t i = 1; i < all.size(); ++i)
        EXPECT_NEAR(all[i], all[i - 1], AcceptedAxis::step * 1.000001);
}

INSTANTIATE_TEST_SUITE_P(Threads, SharedAcceptedDemands, testing::Values(1U, 2U, 4U));

TEST(AcceptedArrays, AreReadElementByElementFromEachOfSeveralDemands) {
    ProbeCluster cluster;
    Probe& writer = cluster.probe("/writer");
    Probe& other = cluster.probe("/other");
    for (const char* path : {"/d1", "/d2"}) {
        Simplex& demand = cluster.tree.add(path, "SharedJoints");
        cluster.tree.relate(writer, "out", demand);
        cluster.tree.relate(other, "out", demand);
    }
    std::vector<std::span<const double>> accepted;
    writer.onPopulate = [&accepted](Probe& self) {
        std::vector<std::span<double>> positions;
        for (const OutputSimplex& demand : self.outputs("out")) {
            accepted.push_back(demand.acceptedArray<double>("positions", "rad"));
            positions.push_back(demand.array<double>("positions"));
        }
        self.onActive = [positions](Probe&, const Tick&) {
            for (const auto each : positions) std::ranges::fill(each, 1);
            positions[1][2] = -1;
        };
    };
    cluster.start();
    cluster.startup(writer);
    cluster.step();

    ASSERT_EQ(accepted.size(), 2U);
    for (const auto each : accepted) ASSERT_EQ(each.size(), 3U);
    EXPECT_DOUBLE_EQ(accepted[0][2], 2 * AcceptedAxis::step);
    EXPECT_DOUBLE_EQ(accepted[1][1], 2 * AcceptedAxis::step);
    EXPECT_DOUBLE_EQ(accepted[1][2], -2 * AcceptedAxis::step);
}

TEST(AcceptedValues, ExistOfDemandsOnlyAndAreGotInPopulate) {
    ProbeCluster cluster;
    Probe& writer = cluster.probe("/writer");
    cluster.tree.relate(writer, "out", cluster.tree.add("/o", "Observation"));
    writer.onPopulate = [](Probe& self) { self.output("out").accepted<double>("position"); };

    try {
        cluster.start();
        FAIL() << "not refused";
    } catch (const Error& error) {
        EXPECT_NE(std::string{error.what()}.find(
                      "/writer: /o.position: only a demand is accepted, this is none"),
                  std::string::npos)
            << error.what();
    }
}

}  // namespace

}  // namespace cortex::test
