// SPDX-License-Identifier: Apache-2.0
#include "support/probe.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {

namespace {

TEST(GroupCommands, StartAWholePlantInCanonicalOrderEachWaitingForThoseBefore) {
    ProbeCluster cluster;
    std::vector<std::string> active;
    Simplex& signal = cluster.tree.add("/plant/s", "Signal");
    Probe& last = cluster.probe("/plant/a-last");
    Probe& first = cluster.probe("/plant/z-first");
    Probe& outside = cluster.probe("/elsewhere");
    cluster.tree.relate(first, "out", signal);
    cluster.tree.relate(last, "in", signal);
    int starting = 0;
    first.onStartingUp = [&](Probe&, const Tick&) { return ++starting == 3; };
    last.onStartingUp = [&](Probe&, const Tick&) {
        EXPECT_EQ(first.state(), State::Active);
        return true;
    };
    cluster.start();

    const CallResult result =
        cluster.call("/test", "startup", {{"prefix", std::vector<std::string>{"/plant"}}});

    EXPECT_EQ(result.outcome, Outcome::Done) << result.text();
    EXPECT_EQ(last.state(), State::Active);
    EXPECT_EQ(outside.state(), State::Standby);
}

TEST(GroupCommands, NameWhoDidNotFollowAndStartNothingThatComesAfter) {
    ProbeCluster cluster;
    Simplex& signal = cluster.tree.add("/s", "Signal");
    Probe& first = cluster.probe("/first");
    Probe& after = cluster.probe("/after");
    cluster.tree.relate(first, "out", signal);
    cluster.tree.relate(after, "in", signal);
    first.onStartingUp = [](Probe& self, const Tick&) {
        self.fault(9, "no pressure");
        return false;
    };
    cluster.start();

    const CallResult result =
        cluster.call("/test", "startup", {{"prefix", std::vector<std::string>{"/"}}});

    EXPECT_EQ(result.outcome, Outcome::Failed);
    EXPECT_NE(result.why.find("/first did not follow: no pressure"), std::string::npos)
        << result.text();
    EXPECT_EQ(after.state(), State::Standby);

    first.onStartingUp = nullptr;
    EXPECT_EQ(
        cluster.call("/test", "clearFaults", {{"prefix", std::vector<std::string>{"/"}}}).outcome,
        Outcome::Done);
    EXPECT_EQ(first.state(), State::Standby);
}

TEST(GroupCommands, LeaveManagedSimplexesToTheirManager) {
    ProbeCluster cluster;
    Probe& manager = cluster.probe("/manager");
    Probe& choice = cluster.probe("/choice");
    cluster.tree.relate(manager, "after", choice);
    Probe::LifeCycleSender sender;
    manager.onPopulate = [&](Probe& self) { sender = self.lifeCycle(self.output("after"), true); };
    manager.onActive = [&](Probe&, const Tick& tick) {
        if (tick.cycle > 20 && sender.state() == State::Standby) sender.startup();
    };
    manager.onShuttingDown = [&](Probe&, const Tick&) {
        if (sender.state() == State::Standby) return true;
        sender.shutdown();
        return false;
    };
    cluster.start();
    const ProgramInterface::Arguments all{{"prefix", std::vector<std::string>{"/"}}};

    EXPECT_EQ(cluster.call("/test", "startup", all).outcome, Outcome::Done);
    EXPECT_EQ(choice.state(), State::Standby);
    cluster.step(25);
    EXPECT_EQ(choice.state(), State::Active);
    EXPECT_EQ(cluster.call("/test", "shutdown", all).outcome, Outcome::Done);
    EXPECT_EQ(choice.state(), State::Standby);
    EXPECT_EQ(manager.state(), State::Standby);
}

TEST(GroupCommands, AShutdownReplacesAStartupThatIsStillGoingOn) {
    ProbeCluster cluster;
    Probe& slow = cluster.probe("/slow");
    slow.onStartingUp = [](Probe&, const Tick&) { return false; };
    cluster.start();
    const ProgramInterface::Arguments all{{"prefix", std::vector<std::string>{"/"}}};
    cluster.cluster->send("/test", "startup", all);
    cluster.step(5);
    ASSERT_EQ(slow.state(), State::StartingUp);

    cluster.call("/test", "shutdown", all);

    EXPECT_EQ(slow.state(), State::Standby);
}

TEST(GroupCommands, NameWhatFaultsWhileItIsShutDown) {
    ProbeCluster cluster;
    Probe& stuck = cluster.probe("/stuck");
    Probe& before = cluster.probe("/before");
    stuck.onShuttingDown = [](Probe& self, const Tick&) {
        self.fault(4, "the brake does not close");
        return false;
    };
    cluster.start();
    cluster.startup(stuck);
    cluster.startup(before);
    const ProgramInterface::Arguments all{{"prefix", std::vector<std::string>{"/"}}};

    const CallResult result = cluster.call("/test", "shutdown", all);

    EXPECT_EQ(result.outcome, Outcome::Failed);
    EXPECT_NE(result.why.find("/stuck did not follow: the brake does not close"), std::string::npos)
        << result.text();
    EXPECT_EQ(before.state(), State::Standby);
    EXPECT_EQ(cluster.call("/test", "shutdown", all).outcome, Outcome::Done);
}

TEST(GroupCommands, ShutDownWhatAManagerLeavesRunningWhenItFaults) {
    ProbeCluster cluster;
    Probe& manager = cluster.probe("/manager");
    Probe& choice = cluster.probe("/choice");
    cluster.tree.relate(manager, "after", choice);
    manager.onPopulate = [](Probe& self) { self.lifeCycle(self.output("after"), true); };
    manager.onShuttingDown = [](Probe& self, const Tick&) {
        self.fault(1, "lost its way");
        return false;
    };
    cluster.start();
    cluster.startup(manager);
    cluster.startup(choice);

    cluster.call("/test", "shutdown", {{"prefix", std::vector<std::string>{"/"}}});

    EXPECT_EQ(manager.state(), State::Fault);
    EXPECT_EQ(choice.state(), State::Standby);
}

}  // namespace

}  // namespace cortex::test
