// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/machine.hpp"

#include "doctor/doctor.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include <sched.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/timex.h>
#include <sys/utsname.h>
#include <time.h>
#include <unistd.h>

namespace cortex::cli {
namespace {

namespace fs = std::filesystem;
using Level = Diagnosis::Level;

constexpr const char* limitsFile = "/etc/security/limits.d/cortex.conf";
constexpr std::uint64_t enoughMemory = 256U << 20;  // bytes that a loop may want to lock

void examineCpus(Diagnoses& found) {
    cpu_set_t set;
    CPU_ZERO(&set);
    sched_getaffinity(0, sizeof set, &set);
    const auto usable = static_cast<std::size_t>(CPU_COUNT(&set));
    const std::string text =
        plural(usable, "CPU") + " usable of " + std::to_string(sysconf(_SC_NPROCESSORS_ONLN));
    if (usable > 1) {
        found.push_back({Level::Ok, "cpu", text, ""});
    } else {
        found.push_back({Level::Warning, "cpu", text + ": a loop shares it with all other programs",
                         "give the process two or more (taskset, cgroup)"});
    }
}

void examineGovernor(Diagnoses& found) {
    std::set<std::string> governors;
    std::error_code ignored;
    for (const auto& each : fs::directory_iterator{"/sys/devices/system/cpu", ignored}) {
        const std::string governor = firstLineOf(each.path() / "cpufreq/scaling_governor");
        if (!governor.empty()) governors.insert(governor);
    }
    const std::string all = joined({governors.begin(), governors.end()});
    if (governors.empty()) {
        found.push_back({Level::Ok, "governor", "the frequency of the CPUs is not set here", ""});
    } else if (all == "performance") {
        found.push_back({Level::Ok, "governor", all, ""});
    } else {
        found.push_back({Level::Warning, "governor", all + ": CPUs slow down between cycles",
                         "sudo cpupower frequency-set -g performance"});
    }
}

void examineKernel(Diagnoses& found) {
    utsname system{};
    uname(&system);
    const std::string version = system.version;
    const bool realTime = firstLineOf("/sys/kernel/realtime") == "1" ||
                          version.find("PREEMPT_RT") != std::string::npos;
    const std::string text = std::string{system.sysname} + " " + system.release;
    if (realTime) {
        found.push_back({Level::Ok, "kernel", text + " is PREEMPT_RT", ""});
    } else {
        found.push_back(
            {Level::Warning, "kernel",
             text + " is not PREEMPT_RT: a cycle may begin milliseconds late",
             "sudo apt install linux-image-rt-amd64, or live with it where nothing moves"});
    }
}

void examinePriority(Diagnoses& found) {
    rlimit limit{};
    getrlimit(RLIMIT_RTPRIO, &limit);
    const bool root = geteuid() == 0;
    if (root || limit.rlim_cur > 0) {
        const std::string most = root ? "99, as root" : std::to_string(limit.rlim_cur);
        found.push_back({Level::Ok, "priority", "real-time priorities up to " + most, ""});
    } else {
        found.push_back({Level::Warning, "priority", "loops may have no real-time priority",
                         std::string{"write '@cortex - rtprio 90' into "} + limitsFile +
                             ", add the user to that group, and log in again"});
    }
    const std::string runtime = firstLineOf("/proc/sys/kernel/sched_rt_runtime_us");
    if (runtime == "0") {
        found.push_back({Level::Error, "throttling", "the system gives real-time threads no time",
                         "sudo sysctl kernel.sched_rt_runtime_us=950000"});
    } else if (!runtime.empty()) {
        const std::string text =
            runtime == "-1" ? "real-time threads are not throttled"
                            : "real-time threads may use " + runtime + " us of each " +
                                  firstLineOf("/proc/sys/kernel/sched_rt_period_us") + " us";
        found.push_back({Level::Ok, "throttling", text, ""});
    }
}

void examineMemory(Diagnoses& found) {
    rlimit limit{};
    getrlimit(RLIMIT_MEMLOCK, &limit);
    const bool enough =
        geteuid() == 0 || limit.rlim_cur == RLIM_INFINITY || limit.rlim_cur >= enoughMemory;
    const std::string text = limit.rlim_cur == RLIM_INFINITY || geteuid() == 0
                                 ? "any amount may be locked"
                                 : std::to_string(limit.rlim_cur >> 10) + " KiB may be locked";
    if (enough) {
        found.push_back({Level::Ok, "memory", text, ""});
    } else {
        found.push_back({Level::Warning, "memory", text + ": a loop may wait for a page",
                         std::string{"write '@cortex - memlock unlimited' into "} + limitsFile +
                             " and log in again"});
    }
}

void examineClocks(Diagnoses& found) {
    timex state{};  // no modes: only reads
    const int result = adjtimex(&state);
    const bool synchronised = result >= 0 && (state.status & STA_UNSYNC) == 0;
    if (synchronised) {
        found.push_back({Level::Ok, "clock",
                         "synchronised, within " + std::to_string(state.maxerror / 1000) + " ms",
                         ""});
    } else {
        found.push_back({Level::Warning, "clock",
                         "the time of day is not synchronised: times of events of several hosts "
                         "cannot be compared",
                         "sudo apt install chrony"});
    }
    timespec resolution{};
    clock_getres(CLOCK_MONOTONIC, &resolution);
    const std::string source =
        firstLineOf("/sys/devices/system/clocksource/clocksource0/current_clocksource");
    const bool fine = resolution.tv_sec == 0 && resolution.tv_nsec <= 1000;
    const bool slow = source == "hpet" || source == "acpi_pm" || source == "jiffies";
    const std::string text = "steps of " + std::to_string(resolution.tv_nsec) + " ns" +
                             (source.empty() ? "" : " from " + source);
    if (fine && !slow) {
        found.push_back({Level::Ok, "timer", text, ""});
    } else {
        found.push_back({Level::Warning, "timer", text + ": too coarse or slow for a fast loop",
                         "look for why the kernel gave up a better one: dmesg | grep clocksource"});
    }
}

// Names of files in shared memory that a process of this user has open.
std::set<std::string> sharedMemoryInUse() {
    std::set<std::string> used;
    std::error_code ignored;
    for (const auto& each : fs::directory_iterator{"/proc", ignored}) {
        std::ifstream maps{each.path() / "maps"};
        for (std::string line; std::getline(maps, line);) {
            const std::size_t begin = line.find("/dev/shm/");
            if (begin != std::string::npos) used.insert(line.substr(begin + 9));
        }
    }
    return used;
}

void examineSharedMemory(Diagnoses& found) {
    const std::set<std::string> used = sharedMemoryInUse();
    std::size_t left = 0;
    std::error_code ignored;
    for (const auto& each : fs::directory_iterator{"/dev/shm", ignored}) {
        struct stat status{};
        const std::string file = each.path().filename();
        const bool dds = file.find("fastrtps_") != std::string::npos ||
                         file.find("fastdds_") != std::string::npos;
        const bool own = stat(each.path().c_str(), &status) == 0 && status.st_uid == geteuid();
        const bool lock = file.ends_with("_el") || file.ends_with("_sl");  // beside a segment
        if (dds && own && !lock && !used.contains(file)) ++left;
    }
    if (left == 0) {
        found.push_back({Level::Ok, "shared memory", "nothing is left over in /dev/shm", ""});
    } else {
        found.push_back(
            {Level::Warning, "shared memory",
             plural(left, "file") + " of killed programs in /dev/shm",
             "when no DDS program runs: fastdds shm clean, or rm /dev/shm/*fastrtps_*"});
    }
}

}  // namespace

void examineMachine(Diagnoses& found) {
    examineCpus(found);
    examineGovernor(found);
    examineKernel(found);
    examineRealTime("/", found);
    examinePriority(found);
    examineMemory(found);
    examineClocks(found);
    examineSharedMemory(found);
    examineLibm(found);
}

}  // namespace cortex::cli
