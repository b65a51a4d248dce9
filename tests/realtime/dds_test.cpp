// SPDX-License-Identifier: Apache-2.0
// An agent's loop on the network, watched like that of a cluster.
#include "cortex/comms/mirror.hpp"

#include "comms/network_agent.hpp"
#include "realtime/watched_cluster.hpp"
#include "support/probe.hpp"

#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include <unistd.h>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

using namespace std::chrono_literals;

TEST(DdsInterface, NeitherAllocatesNorLocksNorCallsTheSystemInTheLoop) {
    NetworkAgent near{"near"}, away{"away"};
    near.rig.tree.relateRemote(near.rig.hand("/boss", "Boss"), "readings", "/far");
    near.rig.tree.add("/plate", "Plate");
    away.rig.tree.add("/far", "Reading");
    near.rig.start();
    away.rig.start();
    RawTool tool{"operator"};
    tool.connect(2);
    Interest wanted;
    wanted.views = {{0, {"/"}}};
    ASSERT_TRUE(tool.interests->write(tool.interest(wanted)));
    ASSERT_TRUE(tool.presences->write(tool.presence()));
    test::checker().reset();
    std::atomic<bool> stop{false};
    std::thread loop{[&] {
        test::checker().watchThisThread();
        while (!stop) {
            test::checker().enterTick();
            near.rig.step();
            test::checker().leaveTick();
            std::this_thread::sleep_for(1ms);
        }
    }};
    const auto value = [&](double wantedValue) {
        away.rig.tree.at("/far").data<double>("a") = wantedValue;
        return comesTrue([&] {
            away.rig.step();
            return near.rig.agent->images().newest().get<double>("/far", "a") == wantedValue;
        });
    };
    for (int round = 1; round <= 20; ++round) {
        EXPECT_TRUE(value(round));
        tool.presences->write(tool.presence());
        ASSERT_TRUE(tool.commands->write(tool.command(near.structure(), "/plate", "set")));
        EXPECT_TRUE(tool.answers.waitFor(static_cast<std::size_t>(round)));
    }
    away.rig.agent->stop();
    EXPECT_TRUE(comesTrue(
        [&] { return near.rig.agent->images().newest().quality("/far") == Quality::Lost; }));
    stop = true;
    loop.join();

    EXPECT_EQ(test::violations(), "");
}

// A real loop at 1 kHz that links a simplex of another agent, while tools come, look at everything,
// command and go, and the other agent goes and comes back.
TEST(DdsCluster, KeepsItsTicksCleanWhileClientsComeAndGo) {
    test::checker().reset();
    SimplexTree tree{TypeModel::load(std::string{CORTEX_SOURCE_DIR} + "/tests/data/cs-rules.xml")};
    auto& probe = tree.add<test::Probe>("/probe", "Probe");
    tree.relateRemote(probe, "observed", "/axis");
    cs::ClusterCS cluster{"near", test::optionsOf(1, geteuid() == 0 ? 10 : 0)};
    test::watch(cluster, 1);
    cluster.addSimplexTree(tree);
    cluster.setTriggerSource<test::WatchedClock>();
    cluster.addInterface<DdsInterface>(loopback());
    cluster.start();
    test::runCycles(cluster, 200);
    const std::uint64_t faults = test::checker().counts().pageFaults;

    const auto axisIs = [&](Quality quality) {
        return comesTrue([&] { return cluster.image().quality("/axis") == quality; });
    };
    for (int round = 0; round < 3; ++round) {
        test::ProbeCluster far{{}, "far"};
        far.tree.add("/axis", "Observation");
        far.cluster->addInterface<DdsInterface>(loopback());
        far.start();
        std::atomic<bool> stop{false};
        std::thread steps{[&] {
            for (; !stop; std::this_thread::sleep_for(1ms)) far.step();
        }};
        std::vector<std::thread> tools;
        for (const std::uint32_t rate : {0U, 30U, 100U}) {
            tools.emplace_back([rate] {
                Mirror mirror{"tool" + std::to_string(rate), loopback()};
                mirror.view({"/"}, rate);
                // The other agent alone may look like all there is.
                const bool found =
                    comesTrue([&] { return mirror.waitForOwner("/probe", 1s).has_value(); });
                ASSERT_TRUE(found);
                EXPECT_TRUE(mirror.waitForValues(10s));
                for (int i = 0; i < 20; ++i) {
                    EXPECT_EQ(mirror.call("/probe", "poke").outcome, Outcome::Done);
                }
            });
        }
        EXPECT_TRUE(axisIs(Quality::Good));
        for (std::thread& tool : tools) tool.join();
        stop = true;
        steps.join();
        far.cluster->stop();
        EXPECT_TRUE(axisIs(Quality::Lost));
    }

    EXPECT_EQ(test::violations(), "");
    EXPECT_EQ(test::checker().counts().pageFaults, faults);
    // In each cycle the loop wakes the communication thread at most once.
    EXPECT_LE(test::checker().counts().futexCalls,
              static_cast<std::uint64_t>(cluster.image().cycle()));
    cluster.stop();
}

}  // namespace
}  // namespace cortex::comms
