// SPDX-License-Identifier: Apache-2.0
#include "threads/realtime_thread.hpp"

#include "cortex/core/machine.hpp"

#include "support/awake_cpus.hpp"

#include <cfenv>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <gtest/gtest.h>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace cortex::cs {
namespace {

using Lines = std::vector<std::string>;

/// Runs the function in a thread of its own, so that the test's thread keeps its settings.
Lines inThread(const auto& function) {
    Lines lines;
    std::thread([&] { lines = function(); }).join();
    return lines;
}

std::string joined(const Lines& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text;
}

/// Ends the (child) process with what an unprivileged user is told.
[[noreturn]] void printAsUnprivileged(int resource, Lines (*function)()) {
    const rlimit none{0, 0};
    setrlimit(static_cast<__rlimit_resource_t>(resource), &none);
    if (geteuid() == 0 && setuid(65534) != 0) std::exit(2);
    std::fputs(joined(function()).c_str(), stderr);
    std::exit(0);
}

TEST(RealtimeThread, FindsTheCpusThatTheProcessMayUse) {
    cpu_set_t set;
    CPU_ZERO(&set);
    ASSERT_EQ(sched_getaffinity(0, sizeof set, &set), 0);

    EXPECT_EQ(usableCpus().size(), static_cast<std::size_t>(CPU_COUNT(&set)));
    for (const int cpu : usableCpus()) EXPECT_TRUE(CPU_ISSET(static_cast<std::size_t>(cpu), &set));
}

// The mask of a process leaves isolated CPUs out, as the mask of this thread leaves out all but
// one.
TEST(RealtimeThread, FindsCpusOutsideOfTheMaskThatMayBeNamed) {
    const std::vector<int> all = usableCpus();
    inThread([&] {
        configureThisThread({.name = "pinned", .affinity = {all.front()}});
        EXPECT_EQ(settableCpus(all), all);
        EXPECT_EQ(placeOfThisThread().cpus, std::vector{all.front()});
        return Lines{};
    });
    EXPECT_EQ(settableCpus({CPU_SETSIZE - 1}), std::vector<int>{});
    EXPECT_EQ(settableCpus({}), std::vector<int>{});
}

TEST(RealtimeThread, StaysOnACpuForAWhileAndThenMayRunWhereItMightBefore) {
    inThread([&] {
        {
            const OnCpu pinned{usableCpus().back()};
            EXPECT_EQ(placeOfThisThread().cpus, std::vector{usableCpus().back()});
        }
        EXPECT_EQ(placeOfThisThread().cpus, usableCpus());
        return Lines{};
    });
}

TEST(RealtimeThread, ReadsTheKernelsListsOfCpus) {
    EXPECT_EQ(cpusOf(""), std::vector<int>{});
    EXPECT_EQ(cpusOf("2-3,6"), (std::vector{2, 3, 6}));
    EXPECT_EQ(cpusOf("(null)"), std::vector<int>{});
}

TEST(RealtimeThread, SpinningIsFreeOnIsolatedCpusAlone) {
    ThreadPlace place;
    place.cpus = {2, 3};
    place.isolated = {3};
    Lines report = spinReport(place, 50, 1000);
    ASSERT_EQ(report.size(), 1U);
    EXPECT_NE(report[0].find("5 % of each period"), std::string::npos) << report[0];
    EXPECT_NE(report[0].find("CPU 2, 3, which is not isolated"), std::string::npos) << report[0];

    place.isolated = {2, 3};
    EXPECT_EQ(spinReport(place, 1000, 1000), Lines{});
}

TEST(RealtimeThread, SpinningForAWholePeriodMeetsTheThrottle) {
    ThreadPlace place;
    place.cpus = place.isolated = {2};
    place.realTime = place.throttled = true;
    const Lines report = spinReport(place, 1000, 1000);
    ASSERT_EQ(report.size(), 1U);
    EXPECT_NE(report[0].find("sched_rt_runtime_us=-1"), std::string::npos) << report[0];

    EXPECT_EQ(spinReport(place, 500, 1000), Lines{});
    place.throttled = false;
    EXPECT_EQ(spinReport(place, 1000, 1000), Lines{});
}

TEST(RealtimeThread, DealsCpusInTurn) {
    const auto& cpus = usableCpus();
    const auto count = static_cast<std::uint32_t>(cpus.size());

    EXPECT_EQ(cpuForThread({}, 0), cpus[0]);
    EXPECT_EQ(cpuForThread({}, count - 1), cpus.back());
    EXPECT_EQ(cpuForThread({}, count), cpus[0]);
    EXPECT_EQ(cpuForThread({cpus.back()}, 5), cpus.back());
    EXPECT_EQ(cpuForThread({100000}, 0), cpus[0]);
}

TEST(RealtimeThread, AllowsOneRealtimeThreadPerCpuAndSaysSo) {
    const std::uint32_t cpus = cpuCount({});
    Lines report;

    EXPECT_EQ(clampThreads(cpus, 50, {}, report), cpus);
    EXPECT_EQ(clampThreads(cpus + 3, 0, {}, report), cpus + 3);
    EXPECT_TRUE(report.empty());

    EXPECT_EQ(clampThreads(4, 50, {usableCpus()[0]}, report), 1U);
    ASSERT_EQ(report.size(), 1U);
    EXPECT_EQ(report[0].rfind("Only 1 of 4 real-time threads are used", 0), 0U) << report[0];
}

// A folder as the kernel has it of CPUs, with what each cache of the first CPU is shared with.
class CpuFolder {
public:
    explicit CpuFolder(const std::vector<std::pair<int, std::string>>& caches)
        : path_{std::filesystem::path{testing::TempDir()} / ("cpus-" + std::to_string(getpid()))} {
        std::filesystem::create_directories(path_);
        int index = 0;
        for (const auto& [level, shared] : caches) {
            const std::filesystem::path cache = path_ /
                                                ("cpu" + std::to_string(cpuForThread({}, 0))) /
                                                ("cache/index" + std::to_string(index++));
            std::filesystem::create_directories(cache);
            std::ofstream{cache / "level"} << level << "\n";
            std::ofstream{cache / "shared_cpu_list"} << shared << "\n";
        }
    }
    ~CpuFolder() { std::filesystem::remove_all(path_); }
    CpuFolder(const CpuFolder&) = delete;
    CpuFolder& operator=(const CpuFolder&) = delete;

    std::string path() const { return path_; }

private:
    std::filesystem::path path_;
};

TEST(RealtimeThread, AllowsOneThreadWhereTheCpusHaveNoLastCacheInCommonAndSaysSo) {
    if (usableCpus().size() < 2) GTEST_SKIP() << "one CPU";
    const std::string first = std::to_string(usableCpus()[0]);
    Lines report;

    const CpuFolder apart{{{1, first}, {1, first}, {2, first}, {3, first}}};
    EXPECT_EQ(threadsWithCommonCache(2, {}, report, apart.path()), 1U);
    ASSERT_EQ(report.size(), 1U);
    EXPECT_EQ(report[0].rfind("Only 1 of 2 threads is used: CPU " + first + ", ", 0), 0U)
        << report[0];
    EXPECT_NE(report[0].find("acrossCaches"), std::string::npos) << report[0];
    EXPECT_EQ(threadsWithCommonCache(1, {}, report, apart.path()), 1U);
    EXPECT_EQ(report.size(), 1U);
}

TEST(RealtimeThread, AllowsAllThreadsWhereTheLastCacheIsSharedOrNotStated) {
    Lines report;
    const CpuFolder shared{{{1, std::to_string(usableCpus()[0])}, {2, "0-8191"}}};
    EXPECT_EQ(threadsWithCommonCache(2, {}, report, shared.path()), 2U);
    EXPECT_EQ(threadsWithCommonCache(2, {}, report, shared.path() + "/nothing"), 2U);
    EXPECT_TRUE(report.empty());
}

TEST(RealtimeThread, PinsAndNamesTheThread) {
    const int cpu = usableCpus().back();
    std::string name(16, ' ');
    int ranOn = -1;

    const Lines report = inThread([&] {
        Lines lines = configureThisThread({"a-name-beyond-fifteen", 0, {cpu}});
        pthread_getname_np(pthread_self(), name.data(), name.size());
        ranOn = sched_getcpu();
        return lines;
    });

    EXPECT_TRUE(report.empty()) << joined(report);
    EXPECT_STREQ(name.c_str(), "a-name-beyond-f");
    EXPECT_EQ(ranOn, cpu);
}

TEST(RealtimeThread, DoesNotInheritThePinOfTheThreadThatMadeIt) {
    int allowed = 0;

    inThread([&] {
        configureThisThread({"pinned", 0, {usableCpus()[0]}});
        return inThread([&] {
            Lines lines = configureThisThread({"free", 0, {}});
            cpu_set_t set;
            sched_getaffinity(0, sizeof set, &set);
            allowed = CPU_COUNT(&set);
            return lines;
        });
    });

    EXPECT_EQ(static_cast<std::size_t>(allowed), usableCpus().size());
}

TEST(RealtimeThread, ReportsACpuThatIsNotThereAndThoseThatAre) {
    const Lines alone = inThread([] { return configureThisThread({"loop", 0, {1000}}); });
    const Lines partly =
        inThread([] { return configureThisThread({"loop", 0, {usableCpus()[0], 1000}}); });

    for (const Lines& report : {alone, partly}) {
        ASSERT_EQ(report.size(), 1U);
        EXPECT_EQ(report[0].rfind("Thread 'loop' should run on CPU ", 0), 0U) << report[0];
        EXPECT_NE(report[0].find("This process may use CPU " + std::to_string(usableCpus()[0])),
                  std::string::npos)
            << report[0];
    }
}

TEST(RealtimeThread, GetsItsPriorityOrSaysHowTo) {
    int policy = -1;
    sched_param parameter{};

    const Lines report = inThread([&] {
        Lines lines = configureThisThread({"loop", 7, {}});
        pthread_getschedparam(pthread_self(), &policy, &parameter);
        return lines;
    });

    if (report.empty()) {
        EXPECT_EQ(policy, SCHED_FIFO);
        EXPECT_EQ(parameter.sched_priority, 7);
    } else {
        EXPECT_NE(joined(report).find("CAP_SYS_NICE"), std::string::npos) << joined(report);
    }
}

TEST(RealtimeThread, ReportsAPriorityOutOfRange) {
    const Lines report = inThread([] { return configureThisThread({"loop", 100, {}}); });

    ASSERT_EQ(report.size(), 1U);
    EXPECT_NE(report[0].find("Use 1 to 99"), std::string::npos) << report[0];
}

TEST(RealtimeThreadDeathTest, TellsAnUnprivilegedUserHowToGetAPriority) {
    EXPECT_EXIT(
        printAsUnprivileged(RLIMIT_RTPRIO, [] { return configureThisThread({"loop", 80, {}}); }),
        ::testing::ExitedWithCode(0),
        "Thread 'loop' did not get priority 80.*CAP_SYS_NICE.*'rtprio 80'");
}

#if defined(__SANITIZE_ADDRESS__)
#define CORTEX_LOCKING_DOES_NOTHING  // the sanitizers see to that
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define CORTEX_LOCKING_DOES_NOTHING  // the sanitizers see to that
#endif
#endif
#if !defined(CORTEX_LOCKING_DOES_NOTHING)
TEST(RealtimeThreadDeathTest, TellsAnUnprivilegedUserHowToLockMemory) {
    EXPECT_EXIT(printAsUnprivileged(RLIMIT_MEMLOCK, [] { return lockMemory(); }),
                ::testing::ExitedWithCode(0), "Memory was not locked.*'memlock unlimited'");
}

TEST(RealtimeThread, LocksMemoryOrSaysHowTo) {
    const Lines report = lockMemory();

    std::string line;
    std::ifstream status("/proc/self/status");
    while (std::getline(status, line) && line.rfind("VmLck:", 0) != 0) {
    }
    munlockall();
    if (report.empty()) {
        EXPECT_GT(std::stoul(line.substr(6)), 0U) << line;
    } else {
        EXPECT_NE(report[0].find("memlock unlimited"), std::string::npos) << report[0];
    }
}
#endif

/// The longest that a CPU of this machine may take to wake up, us.
std::int32_t wakeUpLimit() {
    std::int32_t limit = -1;
    std::ifstream{"/dev/cpu_dma_latency", std::ios::binary}.read(reinterpret_cast<char*>(&limit),
                                                                 sizeof limit);
    return limit;
}

TEST(RealtimeThread, KeepsCpusAwakeForAsLongAsSomebodyAsksForIt) {
    if (const std::string why = test::whyNoAwakeCpus(); !why.empty()) GTEST_SKIP() << why;
    Lines first, second;
    std::optional<AwakeCpus> one{std::in_place, first}, other{std::in_place, second};

    EXPECT_EQ(test::awakeCpuRequests(), 2);
    EXPECT_EQ(wakeUpLimit(), 0);
    one.reset();
    EXPECT_EQ(test::awakeCpuRequests(), 1);
    EXPECT_EQ(wakeUpLimit(), 0);
    other.reset();
    EXPECT_EQ(test::awakeCpuRequests(), 0);
}

TEST(RealtimeThreadDeathTest, TellsAnUnprivilegedUserHowToKeepCpusAwake) {
    if (wakeUpLimit() < 0) GTEST_SKIP() << "the system cannot keep CPUs awake";
    const auto ask = [] {
        Lines report;
        const AwakeCpus awake{report};
        return report;
    };
    EXPECT_EXIT(printAsUnprivileged(RLIMIT_RTPRIO, ask), ::testing::ExitedWithCode(0),
                "Idle CPUs sleep between cycles.*udev.*keepCpusAwake");
}

TEST(RealtimeThread, SaysWhereKeepingCpusAwakeHasNoEffect) {
    EXPECT_TRUE(awakeReport("intel_idle").empty());
    for (const char* none : {"", "none"}) {
        const Lines report = awakeReport(none);
        ASSERT_EQ(report.size(), 1U);
        EXPECT_NE(report.front().find("keepCpusAwake has no effect"), std::string::npos);
        EXPECT_NE(report.front().find("--spin"), std::string::npos) << report.front();
    }
}

TEST(RealtimeThread, RoundsToNearestWithoutFlushingToZero) {
    volatile double one = 1.0, tiny = 1e-20, smallest = std::numeric_limits<double>::min();
    std::fesetround(FE_UPWARD);
    EXPECT_GT(one + tiny, 1.0);
#if defined(__x86_64__)
    _mm_setcsr(_mm_getcsr() | 0x8040);
    EXPECT_EQ(smallest / 4, 0.0);
#endif

    setFloatingPointMode();

    EXPECT_EQ(one + tiny, 1.0);
    EXPECT_GT(smallest / 4, 0.0);
    EXPECT_EQ(std::fegetround(), FE_TONEAREST);
}

}  // namespace
}  // namespace cortex::cs
