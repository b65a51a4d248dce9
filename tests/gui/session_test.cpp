// SPDX-License-Identifier: Apache-2.0
// The session alone: what its thread shares with that of the window.
#include "session/session.hpp"

#include "cortex/comms/dds_interface.hpp"
#include "cortex/comms/lease_client.hpp"

#include "comms/network_agent.hpp"
#include "support/probe.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <string>
#include <thread>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

using gui::CommandOutcome;
using gui::Session;
using test::ProbeCluster;

TEST(Session, IsUsedWhileAgentsComeAndGoAndCommandsAreAnswered) {
    Session session{loopback()};
    std::atomic<bool> ends{false};
    std::atomic<std::size_t> events{0}, frames{0};
    std::thread window{[&] {
        for (std::uint64_t last = 0; !ends;) {
            const auto frame = session.frame();
            EXPECT_GE(frame->number, last);
            if (frame->number != last) ++frames;
            last = frame->number;
            for (const auto& agent : frame->agents) {
                if (agent.structure && agent.image) (void)agent.quality(0);
            }
            session.view(last % 2 == 0 ? std::vector<std::string>{"/"}
                                       : std::vector<std::string>{"/far"});
            events += session.takeEvents().size();
            std::this_thread::yield();
        }
    }};
    for (int start = 0; start < 3; ++start) {
        ProbeCluster far{{}, "far"};
        far.probe("/probe");
        far.cluster->addInterface<DdsInterface>(loopback());
        far.start();
        const auto comes = [&](const auto& condition) {
            return comesTrue([&] {
                // Its nominal time is not ahead of the clock, by which leases and commands end.
                std::this_thread::sleep_for(std::chrono::milliseconds{1});
                far.step();
                return condition();
            });
        };
        EXPECT_TRUE(comes([&] {
            const auto frame = session.frame();
            return std::ranges::any_of(frame->agents, [&](const auto& agent) {
                return agent.structure && !agent.lost() &&
                       agent.structure->epoch == far.cluster->agent().structure().epoch;
            });
        }));
        const std::uint64_t number = session.send("/probe", "startup");
        std::vector<CommandOutcome> outcomes;
        EXPECT_TRUE(comes([&] {
            for (auto& each : session.takeOutcomes()) outcomes.push_back(std::move(each));
            return !outcomes.empty();
        }));
        ASSERT_EQ(outcomes.size(), 1U);
        EXPECT_EQ(outcomes.front().number, number);
        EXPECT_TRUE(outcomes.front().answer.done()) << outcomes.front().answer.text();
    }
    EXPECT_TRUE(comesTrue([&] { return events > 0 && frames > 0; }));
    ends = true;
    window.join();
}

TEST(Session, TakesValuesAsOftenAsIsAsked) {
    ProbeCluster agent{{}, "quick"};
    agent.trigger = nullptr;
    agent.cluster->setTriggerSource<cs::InternalClock>(std::chrono::milliseconds{1});
    agent.cluster->addInterface<DdsInterface>(loopback());
    agent.probe("/ctl");
    agent.start();
    Session session{loopback()};
    session.setRate(5);
    session.view({"/"});
    std::vector<std::int64_t> times;  // nominal ones, ns
    EXPECT_TRUE(comesTrue([&] {
        const auto frame = session.frame();
        if (frame->agents.empty() || !frame->agents.front().came(0)) return false;
        EXPECT_EQ(frame->rate, 5U);
        const std::int64_t time = (*frame->agents.front().image)->nominalTime();
        if (times.empty() || time != times.back()) times.push_back(time);
        return times.size() == 6;
    }));
    agent.cluster->stop();
    ASSERT_EQ(times.size(), 6U);
    EXPECT_GT(times.back() - times[1], 400'000'000) << "four times some 200 ms";
}

// Two agents that run by themselves, and two windows without a screen.
struct TwoAgents : testing::Test {
    struct Agent {
        explicit Agent(const std::string& name) : agent{{}, name} {
            agent.probe("/" + name + "/axis");
            agent.trigger = nullptr;
            agent.cluster->setTriggerSource<cs::InternalClock>(std::chrono::milliseconds{5});
            agent.cluster->addInterface<DdsInterface>(loopback());
            agent.start();
        }
        ~Agent() { agent.cluster->stop(); }
        ProbeCluster agent;
    };
    bool comes(const std::function<bool()>& condition) {
        return comesTrue([&] {
            for (Session* each : {&alice, &bob}) each->isAlive();
            return condition();
        });
    }
    bool holdsBoth(const Session& session) {
        return comes([&] { return session.frame()->control.held.size() == 2; });
    }
    bool seesBoth(const Session& session) {
        return comes([&] {
            const auto frame = session.frame();
            return frame->find("/left/axis") && frame->find("/right/axis");
        });
    }
    // What agents have told so far.
    std::string heard(Session& session) {
        for (const auto& each : session.takeEvents()) told += each.agent + ": " + each.text + '\n';
        return told;
    }

    Agent left{"left"}, right{"right"};
    Session alice{loopback(), "alice@a-host-with-a-name-that-is-long"}, bob{loopback(), "bob"};
    std::string told;
};

TEST_F(TwoAgents, AreCommandedOnBehalfOfWhoUsesTheWindow) {
    ASSERT_TRUE(seesBoth(bob));
    bob.send("/left/axis", "startup");
    bob.takeControl("/");
    ASSERT_TRUE(holdsBoth(bob));
    const std::string self = bob.frame()->control.self;
    const std::string taken = " for bob: takeControl(prefix=\"/\"): Done";
    for (const std::string& event : {"left: " + self + taken, "right: " + self + taken,
                                     "left: " + self + " for bob: startup(): "}) {
        EXPECT_TRUE(comes([&] { return heard(bob).find(event) != std::string::npos; })) << told;
    }
}

// One after the other, in two steps of the window's session. Again, where that took too long.
TEST_F(TwoAgents, HandedOverTogetherAreToldInOneNotice) {
    ASSERT_TRUE(seesBoth(alice) && seesBoth(bob));
    Mirror mirror{"tool", loopback()};
    LeaseClient client{mirror};
    ASSERT_TRUE(mirror.waitUntilComplete(std::chrono::seconds{60}));
    const auto notice = [this] { return alice.frame()->control.notice; };
    const auto tells = [&](const std::string& agent) {
        const std::string said = "Control of / of agent " + agent + " is yours now.";
        return notice().find(said) != std::string::npos;
    };
    bool together = false;
    for (int attempt = 0; attempt < 5 && !together; ++attempt) {
        alice.releaseControl();
        ASSERT_TRUE(comes([&] {
            const auto answers = client.wait(client.take("/", {"left", "right"}));
            return std::ranges::all_of(answers,
                                       [](const auto& each) { return each.answer.done(); });
        }));
        for (const std::string& each : {std::string{"left"}, std::string{"right"}}) {
            client.wait(client.handOver("/", alice.frame()->control.self, {each}));
            ASSERT_TRUE(comes([&] { return tells(each); })) << notice();
        }
        together = tells("left");
    }
    EXPECT_TRUE(together) << notice();
    bob.takeControl("/");
    EXPECT_TRUE(comes([this] { return bob.frame()->control.refusals.size() == 2; }));
    for (const auto& each : bob.frame()->control.refusals)
        EXPECT_NE(each.why.find(" for alice"), std::string::npos) << each.why;
}

TEST(Session, SaysWhyACommandCannotBeSent) {
    Session session{loopback()};
    ASSERT_TRUE(comesTrue([&] { return session.frame()->joined; }));
    const std::uint64_t number = session.send("/nobody", "startup");
    std::vector<CommandOutcome> outcomes;
    ASSERT_TRUE(comesTrue([&] {
        for (auto& each : session.takeOutcomes()) outcomes.push_back(std::move(each));
        return !outcomes.empty();
    }));
    EXPECT_EQ(outcomes.front().number, number);
    EXPECT_NE(outcomes.front().problem.find("/nobody"), std::string::npos)
        << outcomes.front().problem;
}

}  // namespace
}  // namespace cortex::comms
