// SPDX-License-Identifier: Apache-2.0
// An agent's loop on the network, watched like that of a cluster.
#include "comms/network_agent.hpp"
#include "realtime/detectors.hpp"

#include <atomic>
#include <chrono>
#include <thread>

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
    wanted.target = "near";
    wanted.views = {{0, {"/"}}};
    ASSERT_TRUE(tool.models->write(tool.interest(wanted)));
    ASSERT_TRUE(tool.presences->write(tool.presence()));
    test::resetOffences();
    std::atomic<bool> stop{false};
    std::thread loop{[&] {
        test::watchThisThread();
        while (!stop) {
            test::enterTick();
            near.rig.step();
            test::leaveTick();
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

    EXPECT_TRUE(test::offences().none()) << test::offences().text();
}

}  // namespace
}  // namespace cortex::comms
