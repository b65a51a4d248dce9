// SPDX-License-Identifier: Apache-2.0
// The tick is sacred: nothing on the loop's threads allocates, locks, calls the system or meets a
// new page, while the whole case study runs with an observer, commands from outside and a fault.
#include "cortex/core/registry.hpp"
#include "cortex/toolkit/classes.hpp"

#include "realtime/watched_cluster.hpp"
#include "support/probe.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include <linux/futex.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace cortex::test {

namespace {

using namespace std::chrono_literals;

class CaseStudy : public testing::TestWithParam<std::uint32_t> {};

TEST_P(CaseStudy, RunsWithoutAllocationLockSystemCallOrPageFault) {
    checker().reset();
    const std::string root = CORTEX_SOURCE_DIR;
    const std::vector<std::filesystem::path> files{root + "/examples/lbr_teleop/lbr_teleop.xml",
                                                   root + "/tests/data/cs-rules.xml"};
    ClassRegistry registry;
    toolkit::addClasses(registry);
    SimplexTree tree = SimplexTree::load(files, &registry);
    auto& probe = tree.add<Probe>("/probe", "Probe");
    std::atomic<bool> broken{false};
    probe.onActive = [&](Probe& self, const Tick&) {
        if (broken.exchange(false)) self.fault(5, "asked for by the test");
    };
    cs::ClusterCS cluster{"teleop", optionsOf(GetParam(), geteuid() == 0 ? 10 : 0)};
    watch(cluster, GetParam());
    cluster.useClasses(registry);
    cluster.addSimplexTree(tree);
    cluster.setTriggerSource<WatchedClock>();
    std::atomic<int> events{0};
    cluster.addEventSink([&](const Event&, const Structure&) { ++events; });
    cluster.start();
    const CallResult started =
        cluster.call("/teleop", "startup", {{"prefix", std::vector<std::string>{"/"}}}, 20s);
    ASSERT_EQ(started.outcome, Outcome::Done) << started.text();
    runCycles(cluster, 200);

    const cs::HookCounts before = checker().counts();
    const std::int64_t cyclesBefore = cluster.image().cycle();
    std::atomic<bool> observing{true};
    std::thread observer{[&] {
        while (observing) {
            const Image image = cluster.image();
            ASSERT_EQ(image.structure().agent, "teleop");
            std::this_thread::sleep_for(1ms);
        }
    }};
    const int eventsBefore = events;
    for (int round = 0; round < 3; ++round) {
        EXPECT_EQ(cluster.call("/probe", "poke").outcome, Outcome::Done);
        EXPECT_EQ(cluster.call("/probe", "set", {{"gain", std::vector{2.0}}}).outcome,
                  Outcome::Done);
        EXPECT_EQ(cluster.call("/probe", "set", {{"gain", std::vector{99.0}}}).outcome,
                  Outcome::Rejected);
        broken = true;
        runCycles(cluster, 200);
        EXPECT_EQ(cluster.image().get<std::int64_t>("/probe", "state"), 4);
        EXPECT_EQ(cluster.call("/probe", "clearFaults").outcome, Outcome::Done);
        EXPECT_EQ(cluster.call("/probe", "startup").outcome, Outcome::Done);
        runCycles(cluster, 300);
    }
    observing = false;
    observer.join();

    const cs::HookCounts after = checker().counts();
    EXPECT_EQ(violations(), "");
    const std::int64_t cycles = cluster.image().cycle() - cyclesBefore;
    EXPECT_LE(after.futexCalls - before.futexCalls, mostFutexCalls(cycles, GetParam()))
        << "in " << cycles << " cycles";
    EXPECT_EQ(after.pageFaults, before.pageFaults);
    EXPECT_GT(events, eventsBefore) << "the fault and its events are part of the test";
    EXPECT_EQ(cluster.threadsInUse(), GetParam());
    cluster.stop();
}

INSTANTIATE_TEST_SUITE_P(Threads, CaseStudy, testing::Values(1U, 2U, 4U));

// One thing that a hook must not do, and the words for it.
struct Misdeed {
    const char* name;
    void (*commit)();
    const char* words;
};

std::mutex someMutex;
char* freshPage = nullptr;
void* volatile kept = nullptr;

class MisbehavingHook : public testing::TestWithParam<Misdeed> {};

TEST_P(MisbehavingHook, IsNamedWithItsPathTypeHookAndLine) {
    checker().reset();
    SimplexTree tree{TypeModel::load(std::string{CORTEX_SOURCE_DIR} + "/tests/data/cs-rules.xml")};
    auto& probe = tree.add<Probe>("/probe", "Probe");
    std::atomic<bool> armed{false}, done{false};
    probe.onLoopStart = [&](Probe&, const Tick&) {
        if (!armed.exchange(false)) return;
        GetParam().commit();
        done = true;
    };
    kept = std::malloc(24);  // for the hook that gives it back
    munlockall();            // an earlier test may have locked what is still to come
    freshPage = static_cast<char*>(
        mmap(nullptr, 1 << 16, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
    cs::ClusterCS cluster{"watched", optionsOf(1, 0)};
    watch(cluster, 1);
    cluster.addSimplexTree(tree);
    cluster.setTriggerSource<WatchedClock>();
    cluster.start();
    runCycles(cluster, 100);
    ASSERT_EQ(violations(), "");
    static_cast<void>(checker().newViolations());
    armed = true;
    ASSERT_TRUE(comesTrue("what the hook does", [&] { return done.load(); }));
    runCycles(cluster, 2);

    const auto found = checker().newViolations();
    const auto named = std::find_if(found.begin(), found.end(),
                                    [](const auto& each) { return each.what == GetParam().words; });
    ASSERT_NE(named, found.end()) << violations();
    EXPECT_EQ(named->path + " " + named->type + " " + named->hook, "/probe Probe loopStart");
    EXPECT_EQ(named->count, 1U);
    const bool isLast = named->where.starts_with("the last call of the hook");  // if optimised
    EXPECT_TRUE(isLast || named->where.find("realtime") != std::string::npos) << named->where;
    cluster.stop();
    munmap(freshPage, 1 << 16);
}

INSTANTIATE_TEST_SUITE_P(
    Misdeeds, MisbehavingHook,
    testing::Values(
        Misdeed{"malloc", [] { kept = std::malloc(24); }, "allocation of 24 bytes"},
        Misdeed{"free", [] { std::free(kept); }, "memory given back"},
        Misdeed{"operatorNew", [] { kept = ::operator new(8); },  // or an optimiser leaves it out
                "allocation of 8 bytes"},
        Misdeed{"mutex", [] { const std::lock_guard lock{someMutex}; },
                "lock by pthread_mutex_lock"},
        Misdeed{"write",
                [] {
                    const auto written = write(STDERR_FILENO, "", 0);
                    (void)written;
                },
                "output to standard error by write"},
        Misdeed{"stream", [] { std::cout << "from a hook" << std::endl; },
                "output to standard output by fwrite"},
        Misdeed{"throw",
                [] {
                    try {
                        throw 5;
                    } catch (int) {
                    }
                },
                "throw of int"},
        Misdeed{"munmap", [] { munmap(freshPage + (1 << 14), 1 << 12); }, "system call munmap"},
        Misdeed{"madvise", [] { madvise(freshPage, 1 << 12, MADV_DONTNEED); },
                "system call madvise"},
        Misdeed{"signalMask", [] { pthread_sigmask(SIG_BLOCK, nullptr, nullptr); },
                "system call rt_sigprocmask"},
        Misdeed{"sleep", [] { std::this_thread::sleep_for(1us); }, "system call clock_nanosleep"},
        Misdeed{"futex",
                [] {
                    static std::uint32_t word = 0;
                    syscall(SYS_futex, &word, FUTEX_WAKE_PRIVATE, 1, nullptr, nullptr, 0);
                },
                "system call futex"},
        Misdeed{"newPage", [] { freshPage[1 << 15] = 1; }, "page fault"}),
    [](const auto& misdeed) { return std::string{misdeed.param.name}; });

}  // namespace

}  // namespace cortex::test
