// SPDX-License-Identifier: Apache-2.0
// The session alone: what its thread shares with that of the window.
#include "session/session.hpp"

#include "cortex/comms/dds_interface.hpp"

#include "comms/network_agent.hpp"
#include "support/probe.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
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
