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

TEST(GroupCommands, AskAllOfALevelAtOnceAndTheNextOneOnlyThen) {
    ProbeCluster cluster;
    Simplex& signal = cluster.tree.add("/s", "Signal");
    Probe& writer = cluster.probe("/writer");
    Probe& beside = cluster.probe("/beside");
    Probe& reader = cluster.probe("/reader");
    cluster.tree.relate(writer, "out", signal);
    cluster.tree.relate(reader, "in", signal);
    bool mayGoOn = false;
    beside.onStartingUp = beside.onShuttingDown = [&](Probe&, const Tick&) { return mayGoOn; };
    reader.onShuttingDown = [&](Probe&, const Tick&) { return mayGoOn; };
    cluster.start();
    const ProgramInterface::Arguments all{{"prefix", std::vector<std::string>{"/"}}};

    cluster.cluster->send("/test", "startup", all);
    cluster.step(5);
    EXPECT_EQ(writer.state(), State::Active);
    EXPECT_EQ(beside.state(), State::StartingUp);
    EXPECT_EQ(reader.state(), State::Standby);
    mayGoOn = true;
    cluster.step(5);
    EXPECT_EQ(reader.state(), State::Active);

    mayGoOn = false;
    cluster.cluster->send("/test", "shutdown", all);
    cluster.step(5);
    EXPECT_EQ(reader.state(), State::ShuttingDown);
    EXPECT_EQ(writer.state(), State::Active);
    EXPECT_EQ(beside.state(), State::Active);
    mayGoOn = true;
    cluster.step(5);
    EXPECT_EQ(writer.state(), State::Standby);
    EXPECT_EQ(beside.state(), State::Standby);
}

TEST(GroupCommands, NameWhoWaitsForOneInFaultAndStartTheOthers) {
    ProbeCluster cluster;
    Simplex& first = cluster.tree.add("/s1", "Signal");
    Simplex& second = cluster.tree.add("/s2", "Signal");
    Probe& a = cluster.probe("/a");
    Probe& b = cluster.probe("/b");
    Probe& c = cluster.probe("/c");
    Probe& free = cluster.probe("/free");
    cluster.tree.relate(a, "out", first);
    cluster.tree.relate(b, "in", first);
    cluster.tree.relate(b, "out", second);
    cluster.tree.relate(c, "in", second);
    a.onStartingUp = [](Probe& self, const Tick&) {
        self.fault(9, "no air");
        return false;
    };
    cluster.start();

    const CallResult result =
        cluster.call("/test", "startup", {{"prefix", std::vector<std::string>{"/"}}});

    EXPECT_EQ(result.outcome, Outcome::Failed);
    EXPECT_EQ(result.why,
              "/a did not follow: no air; /b waits for /a, which is in Fault: no air; "
              "/c waits for /a, which is in Fault: no air");
    EXPECT_TRUE(cluster.hasEvent("/b: waits for /a, which is in Fault: no air"));
    EXPECT_TRUE(cluster.hasEvent("/c: waits for /a, which is in Fault: no air"));
    EXPECT_EQ(b.state(), State::Standby);
    EXPECT_EQ(c.state(), State::Standby);
    EXPECT_EQ(free.state(), State::Active);
}

TEST(GroupCommands, CountThoseThatAnAnswerHasNoRoomFor) {
    ProbeCluster cluster;
    Simplex& signal = cluster.tree.add("/s", "Signal");
    Probe& first = cluster.probe("/first");
    cluster.tree.relate(first, "out", signal);
    for (const char* path : {"/r1", "/r2", "/r3", "/r4", "/r5"}) {
        cluster.tree.relate(cluster.probe(path), "in", signal);
    }
    first.onStartingUp = [](Probe& self, const Tick&) {
        self.fault(9, "no pressure in the line");
        return false;
    };
    cluster.start();

    const CallResult result =
        cluster.call("/test", "startup", {{"prefix", std::vector<std::string>{"/"}}});

    EXPECT_TRUE(result.why.ends_with("; and 4 more, as events say")) << result.why;
    EXPECT_TRUE(cluster.hasEvent("/r5: waits for /first, which is in Fault"));
}

// As of a loop of 1 Hz, whose stopTimeout is two periods.
TEST(GroupCommands, ShutEachLevelDownAtAStopHoweverFewPeriodsTheStopTimeoutHas) {
    ProbeCluster cluster{{.stopTimeout = 0.002}};
    std::vector<Probe*> probes;
    for (const char* path : {"/p1", "/p2", "/p3", "/p4", "/p5", "/p6"}) {
        Probe& each = cluster.probe(path);
        if (!probes.empty()) cluster.tree.relate(each, "before", *probes.back());
        probes.push_back(&each);
    }
    cluster.start();
    for (Probe* each : probes) cluster.startup(*each);

    EXPECT_TRUE(cluster.cluster->stop());

    EXPECT_EQ(cluster.cluster->notShutDown(), std::vector<std::string>{});
    for (const Probe* each : probes) EXPECT_EQ(each->state(), State::Standby) << each->path();
}

TEST(GroupCommands, NameWhoDidNotGetThroughTheShutdownOfAStop) {
    ProbeCluster cluster{{.stopTimeout = 0.05}};
    Simplex& signal = cluster.tree.add("/s", "Signal");
    Probe& writer = cluster.probe("/writer");
    Probe& reader = cluster.probe("/reader");
    cluster.tree.relate(writer, "out", signal);
    cluster.tree.relate(reader, "in", signal);
    int asked = 0;
    reader.onShuttingDown = [&](Probe&, const Tick&) { return ++asked < 0; };
    cluster.start();
    cluster.startup(writer);
    cluster.startup(reader);

    EXPECT_FALSE(cluster.cluster->stop());

    EXPECT_GT(asked, 0);
    const std::string after = " after the stopTimeout of 0.05 s; now in Standby by force";
    EXPECT_EQ(cluster.cluster->notShutDown(),
              (std::vector<std::string>{
                  "/writer did not follow: waits for /reader, which is in ShuttingDown" + after,
                  "/reader did not follow: ShuttingDown" + after}));
    EXPECT_TRUE(cluster.hasEvent("/reader: did not follow: ShuttingDown" + after));
    EXPECT_EQ(reader.state(), State::Standby);
    EXPECT_EQ(writer.state(), State::Standby);
}

}  // namespace

}  // namespace cortex::test
