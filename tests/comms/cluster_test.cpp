// SPDX-License-Identifier: Apache-2.0
// Clusters on the network: the loop of cs with the interface of comms, in one process.
#include "comms/network_agent.hpp"
#include "support/probe.hpp"
#include "wire/named_values.hpp"

#include <algorithm>
#include <chrono>
#include <optional>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

using test::Probe;
using test::ProbeCluster;

// Steps it until the tool has the final answer.
std::optional<Answer> answered(RawTool& tool, ProbeCluster& cluster, const std::string& path,
                               const std::string& name, std::vector<NamedValue> arguments = {}) {
    const Structure& structure = cluster.cluster->agent().structure();
    const Command command = tool.command(structure, path, name, std::move(arguments));
    EXPECT_TRUE(tool.commands->write(command));
    std::optional<Answer> found;
    comesTrue([&] {
        cluster.step();
        for (const Answer& each : tool.answers.elements()) {
            if (each.sequenceNumber == command.sequenceNumber) found = each;
        }
        return found && found->outcome != "Running";
    });
    return found;
}

// "far" writes /axis, "near" reads it, and both are on the network.
struct TwoClusters : testing::Test {
    TwoClusters() {
        far.tree.relate(writer, "out", far.tree.add("/axis", "Observation"));
        near.tree.relateRemote(reader, "observed", "/axis");
        writer.onPopulate = [this](Probe& self) {
            out = self.output("out").data<double>("position");
        };
        reader.onPopulate = [this](Probe& self) {
            in = self.input("observed").data<double>("position");
        };
        writer.onActive = [this](Probe&, const Tick&) { out = written; };
        reader.onActive = [this](Probe&, const Tick&) { seen = in; };
        near.cluster->addInterface<DdsInterface>(loopback());
        far.cluster->addInterface<DdsInterface>(loopback());
    }
    void start() {
        near.start();
        far.start();
        far.startup(writer);
        ASSERT_TRUE(both([&] { return near.quality("/axis") == Quality::Good; }));
        near.cluster->send("/reader", "startup");
        ASSERT_TRUE(both([&] { return near.state("/reader") == State::Active; }));
    }
    bool both(const std::function<bool()>& condition) {
        return comesTrue([&] {
            far.step();
            near.step();
            return condition();
        });
    }

    ProbeCluster near{{}, "near"}, far{{}, "far"};
    Probe& reader = near.probe("/reader");
    Probe& writer = far.probe("/writer");
    Data<double> out;
    Data<const double> in;
    double written = 1, seen = 0;
};

TEST_F(TwoClusters, LinkASimplexOfTheOther) {
    start();
    for (const double value : {2.0, 2.5, -1.5}) {
        written = value;
        EXPECT_TRUE(both([&] { return seen == value; })) << seen;
    }
}

TEST_F(TwoClusters, WhatHasNeverBeenThereIsNotLostButALossIsTold) {
    near.start();
    near.step(1'500);
    EXPECT_FALSE(near.hasEvent("input observed"));
    EXPECT_TRUE(near.hasEvent("/near: waits for /axis, which no other agent has offered yet"));

    far.start();
    ASSERT_TRUE(both([&] { return near.quality("/axis") == Quality::Stale; }));
    far.cluster->stop();
    EXPECT_TRUE(comesTrue([&] {
        near.step();
        return near.hasEvent("/reader: input observed from /axis is ");
    }));
}

TEST_F(TwoClusters, LoseWhatIsOfTheOtherAndComeBackWithIt) {
    start();
    far.cluster->stop();
    EXPECT_TRUE(comesTrue([&] {
        near.step();
        return near.quality("/axis") == Quality::Lost;
    }));
    EXPECT_TRUE(near.hasEvent("/near: agent far is lost: it stopped"));

    ProbeCluster again{{}, "far"};
    again.tree.add("/axis", "Observation").set("position", 2.0);
    again.cluster->addInterface<DdsInterface>(loopback());
    again.start();
    EXPECT_TRUE(comesTrue([&] {
        again.step();
        near.step();
        return near.number("/axis", "position") == 2;
    }));
}

TEST_F(TwoClusters, ExecuteCommandsFromTheNetworkInTheirCycle) {
    reader.onAdd = [](Probe& self, Call& call) {
        call[self.sum] = call[self.amount] + 1;
        return Outcome::Done;
    };
    start();
    RawTool tool{"operator"};
    tool.connect(2);
    const auto amount = [](double value) {
        return std::vector{namedValue("amount", Value{std::vector{value}})};
    };
    const auto done = answered(tool, near, "/reader", "add", amount(4));
    ASSERT_TRUE(done);
    EXPECT_EQ(done->outcome, "Done") << done->why;
    EXPECT_EQ(done->response, std::vector{namedValue("sum", Value{std::vector{5.0}})});
    const auto refused = answered(tool, near, "/reader", "add", amount(11));
    ASSERT_TRUE(refused);
    EXPECT_EQ(refused->outcome, "Rejected");
    EXPECT_EQ(refused->reason, "range");
    const auto elsewhere = answered(tool, near, "/axis", "set");
    ASSERT_TRUE(elsewhere);
    EXPECT_EQ(elsewhere->outcome, "Rejected");
}

TEST(ClusterOnTwoNetworks, ServesToolsOfBothAndTheirCommandsTogether) {
    NetworkOptions office = loopback();
    office.domain = test::secondDomain();
    ProbeCluster cluster{{}, "robot"};
    Probe& probe = cluster.probe("/probe");
    int pokes = 0;
    probe.onPoke = [&](Probe&, Call&) {
        ++pokes;
        return Outcome::Done;
    };
    cluster.cluster->addInterface<DdsInterface>(loopback());
    cluster.cluster->addInterface<DdsInterface>(office);
    cluster.start();
    RawTool plant{"tool"}, desk{"tool", office};
    plant.connect();
    desk.connect();
    for (int round = 0; round < 3; ++round) {
        for (RawTool* tool : {&plant, &desk}) {
            const auto done = answered(*tool, cluster, "/probe", "poke");
            ASSERT_TRUE(done);
            EXPECT_EQ(done->outcome, "Done") << done->why;
        }
    }
    EXPECT_EQ(pokes, 6);
    EXPECT_EQ(plant.answers.elements().size(), 3U) << "each network has its own answers";
    EXPECT_EQ(desk.answers.elements().size(), 3U);
}

}  // namespace
}  // namespace cortex::comms
