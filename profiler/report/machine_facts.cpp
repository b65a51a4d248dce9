// SPDX-License-Identifier: Apache-2.0
#include "report/machine_facts.hpp"

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

std::string lineOf(const fs::path& file) {
    std::ifstream stream{file};
    std::string line;
    std::getline(stream, line);
    line.erase(line.find_last_not_of(" \t\r\n") + 1);
    return line;
}

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
        const std::string level = lineOf(each.path() / "level"),
                          type = lineOf(each.path() / "type");
        if (level.empty()) continue;
        const char* kind = type == "Data" ? "d" : type == "Instruction" ? "i" : "";
        found.insert("L" + level + kind + " " + lineOf(each.path() / "size"));
    }
    return joined(found);
}

std::string preemption(const fs::path& root, const std::string& kernelVersion) {
    if (lineOf(root / "sys/kernel/realtime") == "1" ||
        kernelVersion.find("PREEMPT_RT") != std::string::npos) {
        return "PREEMPT_RT";
    }
    const std::string modes = lineOf(root / "sys/kernel/debug/sched/preempt");  // "none (full)"
    const std::size_t begin = modes.find('('), end = modes.find(')');
    const std::size_t at = kernelVersion.find("PREEMPT");
    if (begin != std::string::npos && end > begin) {
        return modes.substr(begin + 1, end - begin - 1) + ", not PREEMPT_RT";
    }
    return at == std::string::npos
               ? "voluntary or none"
               : kernelVersion.substr(at, kernelVersion.find(' ', at) - at) + ", not PREEMPT_RT";
}

std::string throttling(const fs::path& root) {
    const std::string runtime = lineOf(root / "proc/sys/kernel/sched_rt_runtime_us");
    if (runtime.empty()) return "unknown";
    if (runtime == "-1") return "real-time threads are not throttled";
    return "real-time threads have " + runtime + " of each " +
           lineOf(root / "proc/sys/kernel/sched_rt_period_us") + " us";
}

std::string priorityLimit() {
    rlimit limit{};
    getrlimit(RLIMIT_RTPRIO, &limit);
    if (geteuid() == 0 || limit.rlim_cur == RLIM_INFINITY) return "any";
    return limit.rlim_cur == 0 ? "none" : "up to " + std::to_string(limit.rlim_cur);
}

std::string virtualised(const fs::path& root) {
    const std::string flags = " " + cpuinfo(root, "flags") + " ";
    if (flags.find(" hypervisor ") != std::string::npos) return "yes";
    return flags.size() > 2 ? "no" : "unknown";
}

std::string load(const fs::path& root) {
    const std::string line = lineOf(root / "proc/loadavg");  // "0.33 0.42 3.20 1/200 4711"
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
        {"virtualised", virtualised(root)},
        {"isolated CPUs", otherwise(lineOf(root / cpus / "isolated"), "none")},
        {"kernel", std::string{system.sysname} + " " + system.release + " " + system.machine},
        {"preemption", preemption(root, system.version)},
        {"throttling", throttling(root)},
        {"clock source", otherwise(lineOf(root / clock), "unknown")},
        {"real-time priorities", priorityLimit()},
        {loadFact, otherwise(load(root), "unknown")},
        {"compiler", compiler()},
    };
}

}  // namespace cortex::profiler
