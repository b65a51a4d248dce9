// SPDX-License-Identifier: Apache-2.0
#include "threads/cpu_claims.hpp"

#include <csignal>
#include <string>

#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace cortex::cs {
namespace {

// CPUs that no machine has. Claims hold for the whole machine, so each process names its own.
const int firstCpu = 70'000 + 3 * getpid();
const std::vector<int> unusedCpus{firstCpu, firstCpu + 1, firstCpu + 2};

struct FilesOfUnusedCpus : testing::Environment {
    void TearDown() override {
        for (const std::string folder : {"/dev/shm", "/run"}) {
            for (const int cpu : unusedCpus) {
                unlink((folder + "/cortex-cpu-" + std::to_string(cpu)).c_str());
            }
        }
    }
};
const auto* const removedAtTheEnd = testing::AddGlobalTestEnvironment(new FilesOfUnusedCpus);

TEST(CpuClaims, AreFreeOnesFirst) {
    CpuClaims one, other;
    EXPECT_EQ(one.take(unusedCpus, 1), (std::vector{firstCpu}));
    EXPECT_EQ(other.take(unusedCpus, 2), (std::vector{firstCpu + 1, firstCpu + 2}));
}

// As a process does that has a network of its own: it does not see the sockets of others.
std::vector<int> claimedInAnotherNetwork(std::size_t count) {
    int ready[2];
    if (pipe(ready) != 0) return {};
    const pid_t child = fork();
    if (child == 0) {
        int number = -1;
        if (unshare(CLONE_NEWNET) == 0 || unshare(CLONE_NEWUSER | CLONE_NEWNET) == 0) {
            CpuClaims claims;
            number = static_cast<int>(claims.take(unusedCpus, count).size());
        }
        (void)!write(ready[1], &number, sizeof number);
        _exit(0);
    }
    close(ready[1]);
    int number = -1;
    (void)!read(ready[0], &number, sizeof number);
    waitpid(child, nullptr, 0);
    close(ready[0]);
    return number < 0 ? std::vector{-1} : std::vector(static_cast<std::size_t>(number), 0);
}

TEST(CpuClaims, HoldAcrossTheNetworkNamespacesOfAMachine) {
    const std::vector<int> free = claimedInAnotherNetwork(3);
    if (free == std::vector{-1}) GTEST_SKIP() << "no network namespace can be made here";
    ASSERT_EQ(free.size(), 3U);

    CpuClaims one;
    one.take(unusedCpus, 2);

    EXPECT_EQ(claimedInAnotherNetwork(2).size(), 0U);
    EXPECT_EQ(claimedInAnotherNetwork(1).size(), 1U) << "the third is free";
}

TEST(CpuClaims, NeedNoFolderThatCanBeWritten) {
    CpuClaims one{{"/nowhere"}}, other{{"/nowhere"}};
    EXPECT_EQ(one.take(unusedCpus, 1), (std::vector{firstCpu}));
    EXPECT_EQ(other.take(unusedCpus, 1), (std::vector{firstCpu + 1}));
}

TEST(CpuClaims, AreAllOrNone) {
    CpuClaims one, other, third;
    one.take(unusedCpus, 2);
    EXPECT_TRUE(other.take(unusedCpus, 2).empty());
    EXPECT_EQ(third.take(unusedCpus, 1), (std::vector{firstCpu + 2}))
        << "the one before kept nothing";
}

TEST(CpuClaims, EndWithTheirOwner) {
    CpuClaims later;
    {
        CpuClaims one;
        one.take(unusedCpus, 3);
        EXPECT_TRUE(later.take(unusedCpus, 1).empty());
    }
    EXPECT_EQ(later.take(unusedCpus, 3), unusedCpus);
}

TEST(CpuClaims, OfAKilledProcessAreFree) {
    int ready[2];
    ASSERT_EQ(pipe(ready), 0);
    const pid_t child = fork();
    if (child == 0) {
        CpuClaims claims;
        const char taken = claims.take(unusedCpus, 3).size() == 3 ? 'y' : 'n';
        (void)!write(ready[1], &taken, 1);
        pause();
        _exit(0);
    }
    close(ready[1]);
    char taken = 'n';
    ASSERT_EQ(read(ready[0], &taken, 1), 1);
    EXPECT_EQ(taken, 'y');
    CpuClaims claims;
    EXPECT_TRUE(claims.take(unusedCpus, 1).empty());
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    EXPECT_EQ(claims.take(unusedCpus, 3), unusedCpus);
    close(ready[0]);
}

}  // namespace
}  // namespace cortex::cs
