// SPDX-License-Identifier: Apache-2.0
#include "comms/order_simulation.hpp"

#include <cstdint>
#include <cstdlib>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

int fromEnvironment(const char* name, int otherwise) {
    const char* text = std::getenv(name);
    return text != nullptr ? std::atoi(text) : otherwise;
}

class OrderOfCommands : public testing::TestWithParam<int> {
protected:
    std::uint64_t seed() const { return static_cast<std::uint64_t>(GetParam()); }
    std::int64_t steps() const { return fromEnvironment("CORTEX_ORDER_STEPS", 6'000); }
};

TEST_P(OrderOfCommands, HoldsWhateverTheNetworkLosesOrRepeatsAndWhoeverIsKilled) {
    Counts counts = Simulation{seed(), chaos(seed())}.run(steps());
    counts.longWaits = 0;  // what an earlier start sent waits for that start

    EXPECT_EQ(counts.wrong(), 0) << "seed " << seed() << ": " << counts.text();
    EXPECT_GT(counts.begun, counts.sent / 4) << "seed " << seed() << ": " << counts.text();
    EXPECT_GT(counts.ended, 0) << "seed " << seed() << ": " << counts.text();
}

TEST_P(OrderOfCommands, NoneWaitsLongerThanItMayWhenTheNetworkLosesSome) {
    Faults faults = chaos(seed());
    faults.killed = faults.cut = faults.agentKilled = faults.stands = 0;
    faults.room = 1024;
    const Counts counts = Simulation{seed(), faults}.run(steps() / 4);

    EXPECT_EQ(counts.wrong(), 0) << "seed " << seed() << ": " << counts.text();
}

TEST_P(OrderOfCommands, NothingWaitsWithoutFaults) {
    const Counts counts =
        Simulation{seed(), {.rate = 1, .refused = 0.02, .notHeard = 0.02}}.run(steps() / 20);

    EXPECT_EQ(counts.wrong() + counts.waits + counts.expired, 0)
        << "seed " << seed() << ": " << counts.text();
}

INSTANTIATE_TEST_SUITE_P(Seeds, OrderOfCommands,
                         testing::Range(1, 1 + fromEnvironment("CORTEX_ORDER_SEEDS", 10)));

}  // namespace
}  // namespace cortex::comms
