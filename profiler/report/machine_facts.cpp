// SPDX-License-Identifier: Apache-2.0
#include "report/machine_facts.hpp"

#include "cortex/core/machine.hpp"

#include <cstdint>
#include <fstream>
#include <set>

#include <sched.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <unistd.h>

namespace cortex::profiler {
namespace {

namespace fs = std::filesystem;

constexpr const char* cpus = "sys/devices/system/cpu";

std::string otherwise(const std::string& text, const char* replacement) {
    return text.empty() ? replacement : text;
}

std::string joined(const std::set<std::string>& parts) {
    std::string result;
    for (const std::string& each : parts) result += (result.empty() ? "" : ", ") + each;
    return result;
}

// A line of /proc/cpuinfo, of the first CPU.
std::string cpuinfo(const fs::path& root, const std::string& key) {
    std::ifstream stream{root / "proc/cpuinfo"};
    for (std::string line; std::getline(stream, line);) {
        const std::size_t colon = line.find(": ");
        if (line.starts_with(key) && colon != std::string::npos) return line.substr(colon + 2);
    }
    return {};
}

std::string usableCpus() {
    cpu_set_t set;
    CPU_ZERO(&set);
    sched_getaffinity(0, sizeof set, &set);
    return std::to_string(CPU_COUNT(&set)) + " usable of " +
           std::to_string(sysconf(_SC_NPROCESSORS_ONLN));
}

std::string caches(const fs::path& root) {
    std::set<std::string> found;
    std::error_code ignored;
    for (const auto& each : fs::directory_iterator{root / cpus / "cpu0/cache", ignored}) {
        const std::string level = firstLineOf(each.path() / "level"),
                          type = firstLineOf(each.path() / "type");
        if (level.empty()) continue;
        const char* kind = type == "Data" ? "d" : type == "Instruction" ? "i" : "";
        found.insert("L" + level + kind + " " + firstLineOf(each.path() / "size"));
    }
    return joined(found);
}

std::string governors(const fs::path& root) {
    std::set<std::string> found;
    std::error_code ignored;
    for (const auto& each : fs::directory_iterator{root / cpus, ignored}) {
        const std::string governor = firstLineOf(each.path() / "cpufreq/scaling_governor");
        if (!governor.empty()) found.insert(governor);
    }
    return joined(found);
}

// What programs have asked for, this one not yet; the kernel's own default is 2000 s.
std::string idleCpus(const fs::path& root) {
    std::int32_t limit = 0;  // us
    std::ifstream file{root / "dev/cpu_dma_latency", std::ios::binary};
    if (!file.read(reinterpret_cast<char*>(&limit), sizeof limit)) return "unknown";
    if (limit == 0) return "do not sleep";
    constexpr std::int32_t unlimited = 2'000'000'000;
    return limit >= unlimited ? "sleep" : "wake up within " + std::to_string(limit) + " us";
}

std::string throttling(const fs::path& root) {
    const std::string runtime = firstLineOf(root / "proc/sys/kernel/sched_rt_runtime_us");
    if (runtime.empty()) return "unknown";
    if (runtime == "-1") return "real-time threads are not throttled";
    return "real-time threads have " + runtime + " of each " +
           firstLineOf(root / "proc/sys/kernel/sched_rt_period_us") + " us";
}

std::string priorityLimit() {
    rlimit limit{};
    getrlimit(RLIMIT_RTPRIO, &limit);
    if (geteuid() == 0 || limit.rlim_cur == RLIM_INFINITY) return "any";
    return limit.rlim_cur == 0 ? "none" : "up to " + std::to_string(limit.rlim_cur);
}

std::string loadOf(const fs::path& root) {
    const std::string line = firstLineOf(root / "proc/loadavg");  // "0.33 0.42 3.20 1/200 4711"
    return line.substr(0, line.rfind(' ', line.find('/')));
}

std::string compiler() {
#if defined __clang__
    const std::string name = "clang " __clang_version__;
#else
    const std::string name = "g++ " __VERSION__;
#endif
#if defined __OPTIMIZE__
    return name + ", optimised";
#else
    return name + ", not optimised";
#endif
}

}  // namespace

std::vector<std::pair<std::string, std::string>> machineFacts(const fs::path& root) {
    utsname system{};
    uname(&system);
    const std::string clock = "sys/devices/system/clocksource/clocksource0/current_clocksource";
    return {
        {"CPU", otherwise(cpuinfo(root, "model name"), system.machine)},
        {"CPUs", usableCpus()},
        {"caches", otherwise(caches(root), "unknown")},
        {"virtualised", isVirtualMachine(root) ? "yes" : "no"},
        {"governor", otherwise(governors(root), "not set here")},
        {"idle CPUs", idleCpus(root)},
        {"isolated CPUs", otherwise(firstLineOf(root / cpus / "isolated"), "none")},
        {"kernel", std::string{system.sysname} + " " + system.release + " " + system.machine},
        {"preemption", otherwise(preemption(root), "unknown")},
        {"throttling", throttling(root)},
        {"clock source", otherwise(firstLineOf(root / clock), "unknown")},
        {"real-time priorities", priorityLimit()},
        {loadFact, otherwise(loadOf(root), "unknown")},
        {"compiler", compiler()},
    };
}

}  // namespace cortex::profiler
