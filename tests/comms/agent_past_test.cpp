// SPDX-License-Identifier: Apache-2.0
// What agents keep of the past and mirrors ask for, over real DDS on the loopback interface.
#include "cortex/comms/mirror.hpp"
#include "cortex/core/event_memory.hpp"

#include "comms/network_agent.hpp"
#include "comms/past_of.hpp"
#include "wire/presence_extras.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

using namespace std::chrono_literals;

constexpr std::int64_t always = EventMemory::always;

struct AgentPastTest : testing::Test {
    AgentPastTest() {
        agent.rig.tree.add("/plate", "Plate");
        agent.rig.start();
        plate = agent.structure().find("/plate");
    }
    void post(EventKind kind, const std::string& text, Severity severity = Severity::Info) {
        AgentRuntime& runtime = *agent.rig.agent;
        runtime.post(runtime.thread(0), severity, kind, plate, EventText{text});
    }
    PastEvents ask(std::int64_t from = 0, std::int64_t until = always) {
        EXPECT_TRUE(mirror.waitUntilComplete(20s));
        return pastOf(mirror, "robot", from, until);
    }
    static std::vector<std::string> texts(const PastEvents& past) {
        std::vector<std::string> all;
        for (const AgentEvent& each : past.events) all.push_back(each.text);
        return all;
    }

    NetworkAgent agent{"robot"};
    std::uint32_t plate = 0;
    Mirror mirror{"tool", loopback()};
};

TEST_F(AgentPastTest, IsKeptThoughChatterFloodsTheEvents) {
    post(EventKind::Command, "desk for alice: move(speed=1): Done in 2 cycles");
    agent.rig.step();
    for (int i = 0; i < 3'000; ++i) {
        post(EventKind::Watchdog, "chatter");
        if (i % 100 == 0) {
            agent.rig.step();
            agent.rig.agent->events().flush();
        }
    }
    post(EventKind::Fault, "it hurts", Severity::Error);
    agent.rig.step();
    agent.rig.agent->events().flush();

    const PastEvents past = ask();
    EXPECT_EQ(past.trouble, "");
    EXPECT_EQ(texts(past), (std::vector<std::string>{
                               "desk for alice: move(speed=1): Done in 2 cycles", "it hurts"}));
    EXPECT_EQ(past.events[0].path, "/plate");
    EXPECT_EQ(past.events[0].kind, "command");
    EXPECT_EQ(past.events[0].epoch, agent.structure().epoch);
    EXPECT_EQ(past.events[1].severity, Severity::Error);
    EXPECT_EQ(past.since.size(), EventMemory::kinds.size());
}

TEST_F(AgentPastTest, HasTheNumbersOfTheEventsThemselves) {
    std::vector<AgentEvent> events;
    std::mutex mutex;
    const Listening listening = mirror.onEvent([&](const AgentEvent& event) {
        const std::lock_guard lock{mutex};
        events.push_back(event);
    });
    for (int i = 0; i < 20; ++i) {
        post(i % 3 == 0 ? EventKind::StateChange : EventKind::Limit, "event");
        agent.rig.step();
    }
    agent.rig.agent->events().flush();
    const PastEvents past = ask();
    ASSERT_EQ(past.events.size(), 7U);
    EXPECT_TRUE(comesTrue([&] {
        const std::lock_guard lock{mutex};
        return std::ranges::all_of(past.events, [&](const AgentEvent& kept) {
            return std::ranges::any_of(events, [&](const AgentEvent& event) {
                return event.number == kept.number && event.kind == kept.kind &&
                       event.cycle == kept.cycle && event.wallClock == kept.wallClock &&
                       event.epoch == kept.epoch;
            });
        });
    }));
}

TEST_F(AgentPastTest, ComesWholeInManyParts) {
    EventMemory& memory = agent.rig.agent->memory();
    std::vector<std::string> expected;
    for (int i = 0; i < 3'000; ++i) {
        KeptEvent event;
        event.kind = EventMemory::kinds[static_cast<std::size_t>(i) % EventMemory::kinds.size()];
        event.severity = Severity::Error;
        event.wallClock = i;
        event.path = "/plate";
        event.text = std::string(static_cast<std::size_t>(i) % 150, 'x') + std::to_string(i);
        if (i >= 100 && i <= 2'900) expected.push_back(event.text);
        memory.keep(std::move(event));
    }
    EXPECT_EQ(texts(ask(100, 2'900)), expected);
}

TEST_F(AgentPastTest, IsToldToSeveralToolsAtOnce) {
    post(EventKind::Command, "first");
    agent.rig.step();
    agent.rig.agent->events().flush();
    std::vector<std::unique_ptr<Mirror>> others;
    for (int i = 0; i < 3; ++i) others.push_back(std::make_unique<Mirror>("o", loopback()));
    std::vector<std::uint64_t> asks;
    for (const auto& each : others) {
        ASSERT_TRUE(each->waitUntilComplete(20s));
        asks.push_back(each->askPast("robot", 0, always));
    }
    for (std::size_t i = 0; i < others.size(); ++i) {
        PastEvents past;
        ASSERT_TRUE(comesTrue([&] { return others[i]->pollPast(asks[i], past); }));
        EXPECT_EQ(past.trouble, "");
        EXPECT_EQ(texts(past), std::vector<std::string>{"first"});
    }
}

TEST_F(AgentPastTest, IsNotAskedOfAnAgentThatWasBuiltBefore) {
    RawTool old{"old"};
    old.connect();
    Presence presence = old.presence();
    presence.role = "agent";
    ASSERT_TRUE(comesTrue([&] {
        old.presences->write(presence);
        const auto agents = mirror.agents();
        return agents.size() == 2 && !agents[0].remembers && agents[1].remembers;
    }));
    const std::uint64_t ask = mirror.askPast("old", 0, always);
    PastEvents past;
    ASSERT_TRUE(comesTrue([&] {
        old.presences->write(presence);
        return mirror.pollPast(ask, past);
    }));
    EXPECT_EQ(past.trouble, "it was built before agents kept a memory");
}

}  // namespace
}  // namespace cortex::comms
