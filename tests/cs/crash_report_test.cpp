// SPDX-License-Identifier: Apache-2.0
#include "support/crash_on_purpose.hpp"
#include "support/probe.hpp"

#include <csignal>
#include <cstddef>
#include <exception>

#include <sys/mman.h>

#include <gtest/gtest.h>

namespace cortex::test {

namespace {

struct CrashReportDeathTest : testing::Test {
    CrashReportDeathTest() { GTEST_FLAG_SET(death_test_style, "threadsafe"); }

    const CrashOnPurpose unreported;
};

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

TEST_F(CrashReportDeathTest, NamesTheHookThatReadsWhatIsNotThere) {
    EXPECT_EXIT(crashIn(&Probe::onLoopStart,
                        [](Probe&, const Tick&) {
                            constexpr std::size_t page = 4096;
                            void* const nothing =
                                mmap(nullptr, page, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
                            *static_cast<volatile char*>(nothing) = 1;
                        }),
                testing::KilledBySignal(SIGSEGV),
                "cortex: SIGSEGV in loopStart of /arm/crashing; the process ends");
}

TEST_F(CrashReportDeathTest, NamesTheHookThatDividesByZero) {
    EXPECT_EXIT(crashIn(&Probe::onStandby, [](Probe&, const Tick&) { raise(SIGFPE); }),
                testing::KilledBySignal(SIGFPE), "cortex: SIGFPE in stateStandby of /arm/crashing");
}

TEST_F(CrashReportDeathTest, NamesTheHookThatTerminates) {
    EXPECT_EXIT(crashIn(&Probe::onLoopEnd, [](Probe&, const Tick&) { std::terminate(); }),
                testing::KilledBySignal(SIGABRT), "cortex: SIGABRT in loopEnd of /arm/crashing");
}

TEST_F(CrashReportDeathTest, NamesTheHookThatOverflowsItsStack) {
    EXPECT_EXIT(crashIn(&Probe::onLoopStart,
                        [](Probe&, const Tick&) {
                            volatile int top = 1;
                            deeper(&top);
                        }),
                testing::KilledBySignal(SIGSEGV), "cortex: SIGSEGV in loopStart of /arm/crashing");
}

}  // namespace

}  // namespace cortex::test
