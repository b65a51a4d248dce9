// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/machine.hpp"

#include "doctor/diagnosis.hpp"
#include "text/output.hpp"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <optional>
#include <set>

#include <unistd.h>

namespace cortex::cli {
namespace {

namespace fs = std::filesystem;
using Level = Diagnosis::Level;

constexpr const char* cpuFolder = "sys/devices/system/cpu";
constexpr const char* latencyFile = "dev/cpu_dma_latency";
constexpr int soonAwake = 20;  // us out of an idle state that a fast loop can bear

std::string listed(const std::vector<int>& cpus) {
    std::vector<std::string> parts;
    for (const int cpu : cpus) parts.push_back(std::to_string(cpu));
    return "CPU " + joined(parts);
}

std::vector<int> without(const std::vector<int>& cpus, const std::vector<int>& others) {
    std::vector<int> rest;
    std::ranges::copy_if(cpus, std::back_inserter(rest),
                         [&](int cpu) { return std::ranges::find(others, cpu) == others.end(); });
    return rest;
}

void examinePreemption(const fs::path& root, Diagnoses& found) {
    const std::string mode = preemption(root);
    if (mode == "PREEMPT_RT") {
        found.push_back({Level::Ok, "preemption", "everywhere (PREEMPT_RT)", ""});
    } else if (mode == "full") {
        found.push_back({Level::Ok, "preemption", "full", ""});
    } else if (mode.empty()) {
        found.push_back({Level::Warning, "preemption",
                         "the system does not say whether a loop can interrupt the kernel",
                         "boot with preempt=full, or look: "
                         "sudo cat /sys/kernel/debug/sched/preempt"});
    } else {
        found.push_back({Level::Warning, "preemption",
                         mode + ": a loop waits until the kernel has finished what it does",
                         "boot with preempt=full, or a kernel with PREEMPT_RT"});
    }
}

void examineIsolation(const fs::path& root, const std::vector<int>& isolated, Diagnoses& found) {
    const std::vector<int> tickless = cpusOf(firstLineOf(root / cpuFolder / "nohz_full"));
    const std::vector<int> ticking = without(isolated, tickless);
    if (isolated.empty()) {
        found.push_back({Level::Warning, "isolation",
                         "no CPU is isolated: other work runs on those of the loop",
                         "boot with, say, isolcpus=2,3 nohz_full=2,3 rcu_nocbs=2,3 and write "
                         "cpus=\"2 3\" into <cluster>"});
    } else if (!ticking.empty()) {
        found.push_back({Level::Warning, "isolation",
                         listed(ticking) + " isolated, but interrupted by the timer tick",
                         "boot with nohz_full= and rcu_nocbs= for the same CPUs as isolcpus="});
    } else {
        found.push_back({Level::Ok, "isolation", listed(isolated) + ", without timer tick", ""});
    }
}

void examineInterrupts(const fs::path& root, const std::vector<int>& isolated, Diagnoses& found) {
    std::set<int> interrupts;
    std::error_code ignored;
    for (const auto& each : fs::directory_iterator{root / "proc/irq", ignored}) {
        std::string cpus = firstLineOf(each.path() / "effective_affinity_list");
        if (cpus.empty()) cpus = firstLineOf(each.path() / "smp_affinity_list");
        if (without(isolated, cpusOf(cpus)).size() == isolated.size()) continue;
        for (const int number : cpusOf(each.path().filename())) interrupts.insert(number);
    }
    if (interrupts.empty()) {
        found.push_back({Level::Ok, "interrupts", "none goes to an isolated CPU", ""});
        return;
    }
    std::vector<std::string> numbers;
    for (const int each : interrupts) numbers.push_back(std::to_string(each));
    found.push_back(
        {Level::Warning, "interrupts",
         plural(numbers.size(), "interrupt") + " may go to an isolated CPU: " + joined(numbers),
         "boot with irqaffinity= and the other CPUs, or write them to "
         "/proc/irq/N/smp_affinity_list; stop irqbalance"});
}

// What the other hardware thread of a core does slows this one down.
void examineCores(const fs::path& root, const std::vector<int>& isolated, Diagnoses& found) {
    std::vector<int> shared;
    for (const int cpu : isolated) {
        const fs::path folder = root / cpuFolder / ("cpu" + std::to_string(cpu)) / "topology";
        const auto siblings = cpusOf(firstLineOf(folder / "thread_siblings_list"));
        if (!without(siblings, isolated).empty()) shared.push_back(cpu);
    }
    if (shared.empty()) {
        found.push_back({Level::Ok, "cores", "no isolated CPU shares its core with others", ""});
    } else {
        found.push_back({Level::Warning, "cores",
                         listed(shared) + " isolated, but on a core with a CPU that is not",
                         "isolate both and use one, or: echo off | sudo tee "
                         "/sys/devices/system/cpu/smt/control"});
    }
}

// The limit in us of the time that a CPU may take to wake up; nothing: there is no limit.
std::optional<int> latencyLimit(const fs::path& root) {
    std::int32_t limit = 0;
    std::ifstream file{root / latencyFile, std::ios::binary};
    if (!file.read(reinterpret_cast<char*>(&limit), sizeof limit)) return std::nullopt;
    return limit;
}

struct IdleState {
    std::string name;
    int latency = 0;  // us
};

// The deepest that is allowed on one of these CPUs.
IdleState deepest(const fs::path& root, const std::vector<int>& cpus) {
    IdleState worst;
    std::error_code ignored;
    for (const int cpu : cpus) {
        const fs::path folder = root / cpuFolder / ("cpu" + std::to_string(cpu)) / "cpuidle";
        for (const auto& each : fs::directory_iterator{folder, ignored}) {
            if (firstLineOf(each.path() / "disable") == "1") continue;
            const std::vector<int> latency = cpusOf(firstLineOf(each.path() / "latency"));
            if (latency.empty() || latency.front() <= worst.latency) continue;
            worst = {firstLineOf(each.path() / "name"), latency.front()};
        }
    }
    return worst;
}

// Of a virtual machine each idle state is deep: the host gives the CPU to others.
void examineIdle(const fs::path& root, const std::vector<int>& isolated, Diagnoses& found) {
    const auto all = cpusOf(firstLineOf(root / cpuFolder / "online"));
    const IdleState state = deepest(root, isolated.empty() ? all : isolated);
    const std::optional<int> limit = latencyLimit(root);
    const std::string takes = state.name + ", " + std::to_string(state.latency) + " us to wake up";
    const bool isGivenAway = isVirtualMachine(root);
    const std::string driver = firstLineOf(root / cpuFolder / "cpuidle/current_driver");
    if ((driver.empty() || driver == "none") && state.name.empty()) {
        found.push_back({isGivenAway ? Level::Warning : Level::Ok, "idle",
                         std::string{isGivenAway ? "idle CPUs are given to the host; " : ""} +
                             "without a cpuidle driver keepCpusAwake has no effect",
                         isGivenAway
                             ? "if cycles begin late, let the clock spin (--spin), or start "
                               "the kernel with idle=poll"
                             : ""});
    } else if (limit && *limit <= (isGivenAway ? 0 : soonAwake)) {
        found.push_back(
            {Level::Ok, "idle",
             "a program keeps CPUs awake: at most " + std::to_string(*limit) + " us to wake up",
             ""});
    } else if (state.latency <= soonAwake && !isGivenAway) {
        found.push_back({Level::Ok, "idle",
                         state.name.empty() ? "no deep idle state" +
                                                  (driver.empty() ? "" : " (driver " + driver + ")")
                                            : "at the deepest " + takes,
                         ""});
    } else if (access((root / latencyFile).c_str(), W_OK) == 0) {
        found.push_back({Level::Ok, "idle", "a loop with a priority will keep CPUs awake", ""});
    } else {
        found.push_back(
            {Level::Warning, "idle",
             isGivenAway ? "idle CPUs are given to the host, which returns them late"
                         : "CPUs sleep as deeply as " + takes,
             "let the user write /dev/cpu_dma_latency (udev: KERNEL==\"cpu_dma_latency\", "
             "GROUP=\"cortex\", MODE=\"0660\"), so that a loop with a priority keeps them awake" +
                 (isGivenAway ? std::string{}
                              : "; or sudo cpupower idle-set -D " + std::to_string(soonAwake))});
    }
}

// Both take pages away and give them back, locked or not.
void examinePages(const fs::path& root, Diagnoses& found) {
    const std::string huge = firstLineOf(root / "sys/kernel/mm/transparent_hugepage/enabled");
    const std::string moved = firstLineOf(root / "proc/sys/kernel/numa_balancing");
    if (huge.find("[always]") != std::string::npos) {
        found.push_back({Level::Warning, "pages",
                         "the kernel joins pages to huge ones: a loop may wait for it",
                         "echo madvise | sudo tee /sys/kernel/mm/transparent_hugepage/enabled"});
    }
    if (!moved.empty() && moved != "0") {
        found.push_back({Level::Warning, "pages",
                         "the kernel moves pages between memory nodes: a loop may wait for it",
                         "sudo sysctl kernel.numa_balancing=0"});
    }
}

void examineHypervisor(const fs::path& root, Diagnoses& found) {
    if (isVirtualMachine(root)) {
        found.push_back({Level::Warning, "hypervisor",
                         "this is a virtual machine: its host decides when a loop runs",
                         "pin its CPUs on the host, measure, or use the machine itself"});
    } else {
        found.push_back({Level::Ok, "hypervisor", "none is seen", ""});
    }
}

}  // namespace

void examineRealTime(const fs::path& root, Diagnoses& found) {
    const std::vector<int> isolated = cpusOf(firstLineOf(root / cpuFolder / "isolated"));
    examinePreemption(root, found);
    examineIsolation(root, isolated, found);
    if (!isolated.empty()) {
        examineInterrupts(root, isolated, found);
        examineCores(root, isolated, found);
    }
    examineIdle(root, isolated, found);
    examinePages(root, found);
    examineHypervisor(root, found);
}

}  // namespace cortex::cli
