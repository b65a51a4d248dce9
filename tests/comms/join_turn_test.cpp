// SPDX-License-Identifier: Apache-2.0
#include "dds/join_turn.hpp"

#include <atomic>
#include <cstdint>
#include <optional>
#include <thread>

#include <unistd.h>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

// No domains of DDS, and nobody else's.
const int ours = 1'000'000 + 2 * getpid(), another = ours + 1;

TEST(JoinTurn, IsOneAfterAnotherInADomain) {
    std::optional<JoinTurn> first{ours};
    std::atomic<bool> started{false}, joined{false};
    std::thread next{[&] {
        started = true;
        const JoinTurn second{ours};
        joined = true;
    }};
    while (!started) std::this_thread::yield();
    for (int i = 0; i < 1'000; ++i) const JoinTurn other{another};
    EXPECT_FALSE(joined);

    first.reset();
    next.join();
    EXPECT_TRUE(joined);
}

TEST(JoinTurn, OfAnotherDomainIsNotWaitedFor) {
    const JoinTurn first{ours};
    const JoinTurn second{another};
}

TEST(JoinTurn, IsKeptUntilAllOthersAreMet) {
    const JoinTurn turn{ours};
    std::uint32_t met = 0;
    turn.meet(20, [&] { return met++; });
    EXPECT_EQ(met, 21);
    turn.meet(0, [&] { return met = 0; });
    EXPECT_EQ(met, 0);
}

TEST(JoinTurn, IsNotKeptForThoseWhoNeverAnswer) {
    const JoinTurn turn{ours};
    std::uint32_t met = 0;
    turn.meet(3, [&] { return met < 2 ? ++met : met; });
    EXPECT_EQ(met, 2);
}

}  // namespace
}  // namespace cortex::comms
