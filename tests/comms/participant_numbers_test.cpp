// SPDX-License-Identifier: Apache-2.0
// Without multicast the first hundred participants of a host are asked; Fast DDS by itself gives no
// number twice in a process.
#include "comms/inbox.hpp"
#include "dds/participant.hpp"

#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

TEST(ParticipantNumbers, AreUsedAgainSoThatALongLivedProcessIsStillFound) {
    for (int i = 0; i < 110; ++i) Participant{loopback(), "gone"};
    Participant agent{loopback(), "agent"}, tool{loopback(), "tool"};
    Inbox<Presence> inbox;
    const auto reader = tool.reader<Presence>(topics::presence, inbox.push());
    const auto writer = agent.writer<Presence>(topics::presence);
    writer->write(Presence{});

    EXPECT_TRUE(inbox.waitFor(1));
}

TEST(ParticipantNumbers, AreTheirOwnWhenManyJoinAtOnce) {
    std::vector<std::unique_ptr<Participant>> joined(8);
    std::vector<std::thread> threads;
    for (auto& place : joined) {
        threads.emplace_back(
            [&place] { place = std::make_unique<Participant>(loopback(), "one"); });
    }
    for (std::thread& thread : threads) thread.join();
    for (const auto& each : joined) EXPECT_NE(each, nullptr);
    Inbox<Presence> inbox;
    std::vector<std::unique_ptr<Reader<Presence>>> readers;
    for (const auto& each : joined) {
        readers.push_back(each->reader<Presence>(topics::presence, inbox.push()));
    }
    const auto writer = joined.front()->writer<Presence>(topics::presence);
    writer->write(Presence{});

    EXPECT_TRUE(inbox.waitFor(joined.size()));
}

}  // namespace
}  // namespace cortex::comms
