// SPDX-License-Identifier: Apache-2.0
// What `cortex doctor` says of kernels that are set up in other ways than this machine's.
#include "core/model_folder.hpp"
#include "doctor/diagnosis.hpp"

#include <algorithm>
#include <cstdint>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using cli::Diagnoses;
using cli::Diagnosis;
using Level = Diagnosis::Level;

// The files of a kernel, as far as they are looked at. It begins as a well prepared one.
class Machine {
public:
    Machine() {
        set("sys/kernel/realtime", "1");
        set("proc/version", "Linux version 6.1.0-rt #1 SMP PREEMPT_RT Debian");
        set("proc/cmdline", "quiet isolcpus=2,3");
        set("proc/cpuinfo", "processor : 0\nflags\t\t: fpu vme");
        set(cpus + "online", "0-3");
        set(cpus + "isolated", "2-3");
        set(cpus + "nohz_full", "2-3");
        for (const char* cpu : {"2", "3"}) {
            set(cpus + "cpu" + cpu + "/topology/thread_siblings_list", cpu);
        }
        set("proc/irq/24/effective_affinity_list", "0");
        set("proc/irq/25/effective_affinity_list", "");
        set("proc/irq/25/smp_affinity_list", "0-1");
        set("sys/kernel/mm/transparent_hugepage/enabled", "always [madvise] never");
        set("proc/sys/kernel/numa_balancing", "0");
    }
    void set(const std::string& file, const std::string& text) const {
        std::filesystem::create_directories((folder_.path() / file).parent_path());
        folder_.write(file, text + "\n");
    }
    // An idle state of CPU 2.
    void sleeps(const std::string& state, const std::string& name, const std::string& latency,
                const std::string& disabled = "0") const {
        const std::string folder = cpus + "cpu2/cpuidle/" + state + "/";
        set(folder + "name", name);
        set(folder + "latency", latency);
        set(folder + "disable", disabled);
    }
    Diagnoses examined() const {
        Diagnoses found;
        cli::examineRealTime(folder_.path(), found);
        return found;
    }
    Diagnosis of(const std::string& subject) const {
        const Diagnoses found = examined();
        const auto it = std::ranges::find(found, subject, &Diagnosis::subject);
        return it == found.end() ? Diagnosis{} : *it;
    }

    const std::string cpus = "sys/devices/system/cpu/";

private:
    ModelFolder folder_;
};

void expectWarning(const Diagnosis& diagnosis, const std::string& message,
                   const std::string& remedy) {
    EXPECT_EQ(diagnosis.level, Level::Warning) << diagnosis.message;
    EXPECT_TRUE(contains(diagnosis.message, message)) << diagnosis.message;
    EXPECT_TRUE(contains(diagnosis.remedy, remedy)) << diagnosis.remedy;
}

TEST(Doctor, HasNothingToSayAgainstAPreparedMachine) {
    const Machine machine;

    for (const Diagnosis& each : machine.examined()) {
        EXPECT_EQ(each.level, Level::Ok) << each.subject << ": " << each.message;
        EXPECT_EQ(each.remedy, "") << each.subject;
    }
    EXPECT_EQ(machine.of("isolation").message, "CPU 2, 3, without timer tick");
}

TEST(Doctor, ReadsThePreemptionModeFromWhereverItIsTold) {
    const Machine machine;
    machine.set("sys/kernel/realtime", "0");
    machine.set("proc/version", "Linux version 6.1.0 #1 SMP PREEMPT_DYNAMIC Debian");
    expectWarning(machine.of("preemption"), "does not say", "preempt=full");

    machine.set("proc/cmdline", "quiet preempt=full");
    EXPECT_EQ(machine.of("preemption").level, Level::Ok);

    machine.set("sys/kernel/debug/sched/preempt", "none (voluntary) full");
    expectWarning(machine.of("preemption"), "voluntary", "preempt=full");

    machine.set("sys/kernel/debug/sched/preempt", "none voluntary (full)");
    EXPECT_EQ(machine.of("preemption").message, "full");
}

TEST(Doctor, MissesIsolatedCpusAndThenTheirQuiet) {
    const Machine machine;
    machine.set(machine.cpus + "nohz_full", "3");
    expectWarning(machine.of("isolation"), "CPU 2 isolated, but", "nohz_full=");

    machine.set(machine.cpus + "isolated", "");
    machine.set(machine.cpus + "nohz_full", "(null)");
    expectWarning(machine.of("isolation"), "no CPU is isolated", "isolcpus=");
    EXPECT_EQ(machine.of("interrupts").message, "");  // of no CPU
}

TEST(Doctor, NamesTheInterruptsOfIsolatedCpus) {
    const Machine machine;
    machine.set("proc/irq/31/effective_affinity_list", "3");
    machine.set("proc/irq/9/smp_affinity_list", "0-3");

    expectWarning(machine.of("interrupts"), "2 interrupts may go to an isolated CPU: 9, 31",
                  "irqaffinity=");
}

TEST(Doctor, SeesAnIsolatedCpuThatSharesItsCore) {
    const Machine machine;
    machine.set(machine.cpus + "cpu3/topology/thread_siblings_list", "1,3");

    expectWarning(machine.of("cores"), "CPU 3 isolated, but on a core", "smt/control");
}

TEST(Doctor, FindsTheDeepestIdleStateThatIsAllowed) {
    const Machine machine;
    machine.sleeps("state1", "C1", "2");
    EXPECT_EQ(machine.of("idle").message, "at the deepest C1, 2 us to wake up");

    machine.sleeps("state3", "C10", "890", "1");
    EXPECT_EQ(machine.of("idle").level, Level::Ok);

    machine.sleeps("state3", "C10", "890");
    expectWarning(machine.of("idle"), "C10, 890 us to wake up", "cpupower idle-set -D 20");

    machine.set("dev/cpu_dma_latency", std::string(4, '\0'));
    EXPECT_EQ(machine.of("idle").message, "a program keeps CPUs awake: at most 0 us to wake up");
}

TEST(Doctor, SeesWhetherALoopMayKeepCpusAwake) {
    const Machine machine;
    machine.sleeps("state1", "C1", "2");
    machine.set("proc/cpuinfo", "processor : 0\nflags\t\t: fpu hypervisor vme");
    expectWarning(machine.of("idle"), "given to the host", "/dev/cpu_dma_latency");

    machine.set("dev/cpu_dma_latency", std::string{"\x10\0\0\0", 4});
    EXPECT_EQ(machine.of("idle").message, "a loop with a priority will keep CPUs awake");

    machine.set("dev/cpu_dma_latency", std::string(4, '\0'));
    EXPECT_EQ(machine.of("idle").message, "a program keeps CPUs awake: at most 0 us to wake up");
}

TEST(Doctor, SaysWhereNoDriverWouldKeepCpusAwake) {
    const Machine machine;
    EXPECT_EQ(machine.of("idle").message, "without a cpuidle driver keepCpusAwake has no effect");

    machine.set("proc/cpuinfo", "processor : 0\nflags\t\t: fpu hypervisor vme");
    expectWarning(machine.of("idle"), "keepCpusAwake has no effect", "--spin");

    machine.set(machine.cpus + "cpuidle/current_driver", "intel_idle");
    expectWarning(machine.of("idle"), "given to the host", "/dev/cpu_dma_latency");
}

TEST(Doctor, WarnsOfPagesThatMoveAndOfAHypervisor) {
    const Machine machine;
    machine.set("sys/kernel/mm/transparent_hugepage/enabled", "[always] madvise never");
    expectWarning(machine.of("pages"), "huge", "madvise");

    machine.set("sys/kernel/mm/transparent_hugepage/enabled", "always madvise [never]");
    machine.set("proc/sys/kernel/numa_balancing", "1");
    expectWarning(machine.of("pages"), "nodes", "numa_balancing=0");

    machine.set("proc/cpuinfo", "processor : 0\nflags\t\t: fpu hypervisor vme");
    expectWarning(machine.of("hypervisor"), "virtual machine", "measure");
}

}  // namespace
}  // namespace cortex::test
