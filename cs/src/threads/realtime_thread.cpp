// SPDX-License-Identifier: Apache-2.0
#include "threads/realtime_thread.hpp"

#include "cortex/core/event_count.hpp"
#include "cortex/core/machine.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cfenv>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace cortex::cs {
namespace {

constexpr std::size_t prefaultedBytes = 262144;
constexpr const char* latencyFile = "/dev/cpu_dma_latency";

std::string reason(int error) { return std::generic_category().message(error); }

std::string listed(const std::vector<int>& cpus) {
    std::string text;
    for (const int cpu : cpus) text += (text.empty() ? "" : ", ") + std::to_string(cpu);
    return text;
}

std::vector<int> allowedCpus() {
    cpu_set_t set;
    CPU_ZERO(&set);
    std::vector<int> cpus;
    if (sched_getaffinity(0, sizeof set, &set) == 0) {
        for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
            if (CPU_ISSET(static_cast<std::size_t>(cpu), &set)) cpus.push_back(cpu);
        }
    }
    if (cpus.empty()) cpus.push_back(0);
    return cpus;
}

// The CPUs that share the last-level cache of this one; empty where the system states no cache.
std::vector<int> cpusOfLastCache(const std::string& cpuFolder, int cpu) {
    std::string last, cpus;
    for (int index = 0;; ++index) {
        const std::string cache =
            cpuFolder + "/cpu" + std::to_string(cpu) + "/cache/index" + std::to_string(index);
        const std::string level = firstLineOf(cache + "/level");
        if (level.empty()) return cpusOf(cpus);
        if (level <= last) continue;  // one digit
        last = level;
        cpus = firstLineOf(cache + "/shared_cpu_list");
    }
}

// Isolated CPUs are not in the mask that a process begins with, but can be used where they are
// named.
const std::vector<int>& nameableCpus() {
    static const std::vector<int> found = [] {
        std::vector<int> cpus = usableCpus();
        const auto isolated = settableCpus(cpusOf(firstLineOf("/sys/devices/system/cpu/isolated")));
        cpus.insert(cpus.end(), isolated.begin(), isolated.end());
        std::ranges::sort(cpus);
        cpus.erase(std::ranges::unique(cpus).begin(), cpus.end());
        return cpus;
    }();
    return found;
}

// Those of the wanted CPUs that are there; all usable, where none was wanted or is there.
std::vector<int> chosenCpus(const std::vector<int>& wanted) {
    std::vector<int> chosen;
    for (const int cpu : nameableCpus()) {
        if (std::find(wanted.begin(), wanted.end(), cpu) != wanted.end()) chosen.push_back(cpu);
    }
    return chosen.empty() ? usableCpus() : chosen;
}

// Sets all usable CPUs where none was wanted: a thread inherits the mask of the one that made it.
int place(pthread_t thread, const std::vector<int>& cpus) {
    cpu_set_t set;
    CPU_ZERO(&set);
    for (const int cpu : cpus) {
        if (cpu >= 0 && cpu < CPU_SETSIZE) CPU_SET(static_cast<std::size_t>(cpu), &set);
    }
    return pthread_setaffinity_np(thread, sizeof set, &set);
}

void setAffinity(const ThreadOptions& options, std::vector<std::string>& report) {
    const std::vector<int>& wanted = options.affinity.empty() ? usableCpus() : options.affinity;
    const int error = place(pthread_self(), wanted);
    const std::vector<int> got = allowedCpus();
    const bool isComplete = std::all_of(wanted.begin(), wanted.end(), [&](int cpu) {
        return std::find(got.begin(), got.end(), cpu) != got.end();
    });
    if (error == 0 && isComplete) return;
    report.push_back("Thread '" + options.name + "' should run on CPU " + listed(wanted) +
                     (error == 0 ? "" : " (" + reason(error) + ")") + " and runs on CPU " +
                     listed(got) + ". This process may use CPU " + listed(nameableCpus()) +
                     "; name only these.");
}

void setPriority(const ThreadOptions& options, std::vector<std::string>& report) {
    if (options.priority == 0) return;
    sched_param parameter{};
    parameter.sched_priority = options.priority;
    const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameter);
    if (error == 0) return;
    report.push_back("Thread '" + options.name + "' did not get priority " +
                     std::to_string(options.priority) + " (" + reason(error) +
                     "): its lateness is what the system's load makes it. Use 1 to 99; grant the "
                     "program CAP_SYS_NICE, or its user 'rtprio " +
                     std::to_string(std::clamp(options.priority, 1, 99)) +
                     "' in /etc/security/limits.d.");
}

}  // namespace

const std::vector<int>& usableCpus() {
    static const std::vector<int> found = allowedCpus();
    return found;
}

std::vector<int> settableCpus(const std::vector<int>& wanted) {
    std::vector<int> got;
    if (wanted.empty()) return got;
    std::thread{[&] {  // not this thread: it is to stay where it is
        cpu_set_t set;
        CPU_ZERO(&set);
        for (const int cpu : wanted) CPU_SET(static_cast<std::size_t>(cpu), &set);
        if (pthread_setaffinity_np(pthread_self(), sizeof set, &set) == 0) got = allowedCpus();
    }}
        .join();
    return got;
}

std::uint32_t cpuCount(const std::vector<int>& affinity) {
    return static_cast<std::uint32_t>(chosenCpus(affinity).size());
}

int cpuForThread(const std::vector<int>& affinity, std::uint32_t thread) {
    const std::vector<int> cpus = chosenCpus(affinity);
    return cpus[thread % cpus.size()];
}

std::uint32_t clampThreads(std::uint32_t wanted, int priority, const std::vector<int>& affinity,
                           std::vector<std::string>& report) {
    const std::uint32_t most = cpuCount(affinity);
    if (priority == 0 || wanted <= most) return wanted;
    report.push_back("Only " + std::to_string(most) + " of " + std::to_string(wanted) +
                     " real-time threads are used: each needs a CPU of its own, and CPU " +
                     listed(chosenCpus(affinity)) +
                     " is all there is. Name more CPUs or ask for fewer threads.");
    return most;
}

std::uint32_t threadsWithCommonCache(std::uint32_t wanted, const std::vector<int>& affinity,
                                     std::vector<std::string>& report,
                                     const std::string& cpuFolder) {
    const int first = cpuForThread(affinity, 0);
    const std::vector<int> near = cpusOfLastCache(cpuFolder, first);
    for (std::uint32_t thread = 1; thread < wanted && !near.empty(); ++thread) {
        const int cpu = cpuForThread(affinity, thread);
        if (std::ranges::find(near, cpu) != near.end()) continue;
        report.push_back("Only 1 of " + std::to_string(wanted) + " threads is used: CPU " +
                         listed({first, cpu}) +
                         " have no last-level cache in common, so threads that share the tasks "
                         "would be slower than one. Name CPUs in 'cpus' that share a cache, or set "
                         "acrossCaches, in code or at <cluster>.");
        return 1;
    }
    return wanted;
}

std::vector<std::string> configureThisThread(const ThreadOptions& options) {
    usableCpus();  // found before this thread is pinned
    std::vector<std::string> report;
    pthread_setname_np(pthread_self(), options.name.substr(0, 15).c_str());
    setAffinity(options, report);
    setPriority(options, report);
    sleepPunctually();
    return report;
}

void configureBlockingThread(const std::string& name) {
    pthread_setname_np(pthread_self(), name.substr(0, 15).c_str());
    const sched_param none{};
    pthread_setschedparam(pthread_self(), SCHED_OTHER, &none);  // lower is never refused
}

void placeThread(std::thread::native_handle_type thread, const std::vector<int>& cpus) {
    place(thread, cpus.empty() ? usableCpus() : cpus);
}

OnCpu::OnCpu(int cpu) : before_{allowedCpus()} {
    usableCpus();  // found before this thread is pinned
    place(pthread_self(), {cpu});
}

OnCpu::~OnCpu() { place(pthread_self(), before_); }

std::vector<std::string> lockMemory() {
    rlimit limit{};
    getrlimit(RLIMIT_MEMLOCK, &limit);
    // Under a limit, locking later memory too would make later allocations fail instead.
    const bool isLimited = limit.rlim_cur != RLIM_INFINITY && geteuid() != 0;
    const int flags = isLimited ? MCL_CURRENT : MCL_CURRENT | MCL_FUTURE;
    const std::string remedy =
        "grant the program CAP_IPC_LOCK, or its user 'memlock unlimited' in "
        "/etc/security/limits.d.";
    if (mlockall(flags) != 0) {
        return {"Memory was not locked (" + reason(errno) +
                "): a page fault can delay a cycle. To lock it, " + remedy};
    }
    if (!isLimited) return {};
    return {"Only the memory in use now was locked, because the process has a limit of " +
            std::to_string(limit.rlim_cur / 1024) + " KiB. To lock all, " + remedy};
}

std::vector<std::string> awakeReport(const std::string& idleDriver) {
    if (!idleDriver.empty() && idleDriver != "none") return {};
    return {
        "keepCpusAwake has no effect: this system has no cpuidle driver that would follow it, "
        "so how deep idle CPUs sleep is decided elsewhere, in a virtual machine by its host. "
        "If cycles begin late, let the clock spin (--spin), or start the kernel with idle=poll."};
}

AwakeCpus::AwakeCpus(std::vector<std::string>& report)
    : request_{open(latencyFile, O_WRONLY | O_CLOEXEC)} {
    // https://docs.kernel.org/power/pm_qos_interface.html: the longest wake-up in us, as 32 bits
    constexpr std::int32_t noSleep = 0;
    if (request_ >= 0 && write(request_, &noSleep, sizeof noSleep) == sizeof noSleep) {
        const std::string driver = firstLineOf("/sys/devices/system/cpu/cpuidle/current_driver");
        for (std::string& line : awakeReport(driver)) report.push_back(std::move(line));
        return;
    }
    report.push_back("Idle CPUs sleep between cycles (" + std::string{latencyFile} + ": " +
                     reason(errno) +
                     "), so a cycle can begin late. To keep them awake, let the user write that "
                     "file: 'KERNEL==\"cpu_dma_latency\", GROUP=\"cortex\", MODE=\"0660\"' in "
                     "/etc/udev/rules.d; or set keepCpusAwake to false.");
}

AwakeCpus::~AwakeCpus() {
    if (request_ >= 0) close(request_);
}

ThreadPlace placeOfThisThread() {
    ThreadPlace place;
    place.cpus = allowedCpus();
    place.isolated = cpusOf(firstLineOf("/sys/devices/system/cpu/isolated"));
    int policy = SCHED_OTHER;
    sched_param parameter{};
    pthread_getschedparam(pthread_self(), &policy, &parameter);
    place.realTime = policy == SCHED_FIFO || policy == SCHED_RR;
    place.throttled = firstLineOf("/proc/sys/kernel/sched_rt_runtime_us") != "-1";
    return place;
}

std::vector<std::string> spinReport(const ThreadPlace& place, std::int64_t spin,
                                    std::int64_t period) {
    const std::int64_t share = 100 * spin / period;
    std::vector<std::string> report;
    const bool alone = std::ranges::all_of(place.cpus, [&](int cpu) {
        return std::ranges::find(place.isolated, cpu) != place.isolated.end();
    });
    if (!alone) {
        report.push_back("The clock spins for " + std::to_string(share) +
                         " % of each period and takes that time from others on CPU " +
                         listed(place.cpus) +
                         ", which is not isolated. Isolate a CPU (isolcpus=…, nohz_full=…) and "
                         "name it in 'cpus', or let the clock sleep.");
    }
    constexpr std::int64_t mostSpinning = 80;  // %; cycles take time, too
    if (place.realTime && place.throttled && share > mostSpinning) {
        report.push_back(
            "The clock spins for " + std::to_string(share) +
            " % of each period at real-time priority: the kernel may stop the loop for "
            "some 50 ms of each second, on purpose. Spin for less, or "
            "'sysctl kernel.sched_rt_runtime_us=-1'.");
    }
    return report;
}

[[gnu::noinline]] void prefaultStack() noexcept {
    std::array<volatile char, prefaultedBytes> stack;
    constexpr std::size_t smallestPage = 4096;
    for (std::size_t i = 0; i < stack.size(); i += smallestPage) stack[i] = 0;
}

void setFloatingPointMode() noexcept {
#if defined(__x86_64__)
    // Traps masked; rounding and flush bits zero. The old unit still computes long double.
    constexpr unsigned vectorUnit = 0x1F80;
    constexpr std::uint16_t oldUnit = 0x037F;
    _mm_setcsr(vectorUnit);
    asm volatile("fldcw %0" : : "m"(oldUnit));
#else
    std::fesetenv(FE_DFL_ENV);
#endif
}

}  // namespace cortex::cs
