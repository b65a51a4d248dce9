// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/cluster_cs.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cortex::cs {

// Something that a hook did and that no tick may wait for, at one place of the code.
struct HookViolation {
    std::string path, type, hook;  // "/tank", "Tank", "stateActive"; path empty: outside of hooks
    std::string what;              // "allocation of 24 bytes", "system call openat"
    std::string where;             // "Tank::stateActive at tank.cpp:42", as far as it is known
    std::uint64_t count = 0;

    std::string text() const {  // without the count
        std::string text = path.empty() ? "outside of hooks" : path + " (" + type + "), " + hook;
        text += ": " + what;
        return where.empty() ? text : text + ", in " + where;
    }
};

// Of all hooks that were watched, since the start or the last reset().
struct HookCounts {
    std::uint64_t allocations = 0;  // malloc and free, operator new and delete
    std::uint64_t locks = 0;        // mutexes, read-write locks, spin locks, semaphores, conditions
    std::uint64_t systemCalls = 0;  // but for futex
    std::uint64_t futexCalls = 0;   // also those by which the loop wakes its threads: no violation
    std::uint64_t pageFaults = 0;
    std::uint64_t throws = 0;
    std::uint64_t outputs = 0;  // to standard output, standard error or a file of stdio

    bool none() const;  // but for futex calls
    std::string text() const;
};

// Judges the hooks of clusters while they run. Stands in a library of its own, which replaces
// malloc, pthread_mutex_lock and their like in the whole process: a program links
// cortex::hook_checker, or is started by `cortex-agent --check-hooks`. Program's thread, but for
// enterTick() and leaveTick().
class HookChecker {
public:
    static HookChecker& ofProcess();

    // Before start(), after ClusterTesting::set(). Throws Error where another malloc comes first.
    virtual void watch(ClusterCS& cluster);
    // On a thread that runs hooks otherwise, for instance one that steps an agent.
    virtual void watchThisThread();
    // On a watched thread: in between what is outside of hooks counts as well. Its path is "".
    virtual void enterTick();
    virtual void leaveTick();

    // In the order in which they were found. While hooks run, too.
    virtual std::vector<HookViolation> violations() const;
    // Those that the last call did not give.
    virtual std::vector<HookViolation> newViolations();
    virtual HookCounts counts() const;
    // Why page faults are not looked at; "": they are. From the first thread on.
    virtual std::string withoutPageFaults() const;
    virtual void reset();

    HookChecker(const HookChecker&) = delete;
    HookChecker& operator=(const HookChecker&) = delete;

protected:
    HookChecker() = default;
    virtual ~HookChecker() = default;

private:
    std::size_t given_ = 0;
};

}  // namespace cortex::cs

// For a program that finds the library at run time alone: dlsym(RTLD_DEFAULT, "cortexHookChecker").
extern "C" cortex::cs::HookChecker* cortexHookChecker();
