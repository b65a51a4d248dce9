// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

namespace cortex::cs {

// The only place with calls for scheduling and memory locking. Each asks the system, and returns in
// sentences what the system refused and what helps; nothing here fails.

struct ThreadOptions {
    std::string name;             // the first 15 characters are shown by the system
    int priority = 0;             // 1 to 99: SCHED_FIFO; 0: as the thread has it
    std::vector<int> affinity{};  // CPUs; empty: all that the process may use
};

// The CPUs that the process may use, as found at the first call (before any thread was pinned).
const std::vector<int>& usableCpus();

// Those of the CPUs (below CPU_SETSIZE) that the kernel lets a thread of this process run on,
// whether the process has them in its mask or not.
std::vector<int> settableCpus(const std::vector<int>& wanted);

// How many of these CPUs the process may use; empty: all usable. Isolated ones count where named.
std::uint32_t cpuCount(const std::vector<int>& affinity);

// Where the n-th real-time thread is pinned; 0 is the loop's own.
int cpuForThread(const std::vector<int>& affinity, std::uint32_t thread);

// `wanted`, or for real-time threads at most one per CPU, with a line of report.
std::uint32_t clampThreads(std::uint32_t wanted, int priority, const std::vector<int>& affinity,
                           std::vector<std::string>& report);

// `wanted`, or 1 with a line of report where the CPUs of so many threads have no last-level cache
// in common, as the system states it: threads that share tasks are slower there than one.
std::uint32_t threadsWithCommonCache(std::uint32_t wanted, const std::vector<int>& affinity,
                                     std::vector<std::string>& report,
                                     const std::string& cpuFolder = "/sys/devices/system/cpu");

// Sets name, CPUs and priority of the calling thread.
std::vector<std::string> configureThisThread(const ThreadOptions& options);

// The calling thread gets the name, and no real-time priority, whoever made it.
void configureBlockingThread(const std::string& name);

// Moves another thread to these CPUs; empty: all that the process may use.
void placeThread(std::thread::native_handle_type thread, const std::vector<int>& cpus);

// The calling thread runs on this CPU while one exists; where the system refuses, where it was.
class OnCpu {
public:
    explicit OnCpu(int cpu);
    ~OnCpu();
    OnCpu(const OnCpu&) = delete;
    OnCpu& operator=(const OnCpu&) = delete;

private:
    std::vector<int> before_;
};

// Keeps all memory of the process resident, what it obtains later included.
std::vector<std::string> lockMemory();

// What speaks against AwakeCpus where this driver of cpuidle (empty or "none": none) manages the
// sleep of idle CPUs.
std::vector<std::string> awakeReport(const std::string& idleDriver);

// While one exists, no idle CPU of this machine sleeps: a CPU that does needs time to wake up, and
// one of a virtual machine is given to others until they return it. This costs power.
class AwakeCpus {
public:
    // Adds to the report if the system refuses.
    explicit AwakeCpus(std::vector<std::string>& report);
    ~AwakeCpus();
    AwakeCpus(const AwakeCpus&) = delete;
    AwakeCpus& operator=(const AwakeCpus&) = delete;

private:
    int request_;  // the kernel withdraws it when this file is closed, however the process ends
};

// Where a thread runs that does not sleep.
struct ThreadPlace {
    std::vector<int> cpus;
    std::vector<int> isolated;  // CPUs on which the kernel puts nothing of itself
    bool realTime = false;      // its priority is
    bool throttled = false;     // the kernel stops real-time threads that leave nothing to others
};
ThreadPlace placeOfThisThread();

// What spinning for `spin` of each `period` (ns) does to others there, and they to it.
std::vector<std::string> spinReport(const ThreadPlace& place, std::int64_t spin,
                                    std::int64_t period);

// Touches the calling thread's stack, so that the loop meets no page fault on it.
void prefaultStack() noexcept;

// Round to nearest, no flush to zero, no floating-point traps: results must not depend on the
// thread. Every thread of the loop calls it at the start of each cycle (a few nanoseconds).
void setFloatingPointMode() noexcept;

}  // namespace cortex::cs
