// SPDX-License-Identifier: Apache-2.0
#include "support/probe.hpp"

#include <csignal>
#include <cstddef>
#include <exception>

#include <sys/mman.h>
#include <sys/wait.h>

#include <gtest/gtest.h>

namespace cortex::test {

namespace {

using CrashReportDeathTest = testing::Test;

// A sanitizer makes an exit code of the signal.
auto endedBy(int signal) {
    return [signal](int status) {
        return testing::KilledBySignal(signal)(status) ||
               (WIFEXITED(status) && WEXITSTATUS(status) != 0);
    };
}

void crashIn(Probe::Hook Probe::* hook, const Probe::Hook& crash) {
    ProbeCluster cluster;
    cluster.probe("/arm/crashing").*hook = crash;
    cluster.start();
    cluster.step(2);
}

int deeper(volatile int* above) {
    volatile int here = *above + 1;
    return here < 0 ? 0 : deeper(&here) + here;  // its frame is needed until it returns: never
}

TEST(CrashReportDeathTest, NamesTheHookThatReadsWhatIsNotThere) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(crashIn(&Probe::onLoopStart,
                        [](Probe&, const Tick&) {
                            constexpr std::size_t page = 4096;
                            void* const nothing =
                                mmap(nullptr, page, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
                            *static_cast<volatile char*>(nothing) = 1;
                        }),
                endedBy(SIGSEGV),
                "cortex: SIGSEGV in loopStart of /arm/crashing; the process ends");
}

TEST(CrashReportDeathTest, NamesTheHookThatDividesByZero) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(crashIn(&Probe::onStandby, [](Probe&, const Tick&) { raise(SIGFPE); }),
                endedBy(SIGFPE), "cortex: SIGFPE in stateStandby of /arm/crashing");
}

TEST(CrashReportDeathTest, NamesTheHookThatTerminates) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(crashIn(&Probe::onLoopEnd, [](Probe&, const Tick&) { std::terminate(); }),
                endedBy(SIGABRT), "cortex: SIGABRT in loopEnd of /arm/crashing");
}

TEST(CrashReportDeathTest, NamesTheHookThatOverflowsItsStack) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(crashIn(&Probe::onLoopStart,
                        [](Probe&, const Tick&) {
                            volatile int top = 1;
                            deeper(&top);
                        }),
                endedBy(SIGSEGV), "cortex: SIGSEGV in loopStart of /arm/crashing");
}

}  // namespace

}  // namespace cortex::test
