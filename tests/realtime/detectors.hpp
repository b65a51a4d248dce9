// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace cortex::test {

// What the loop's threads must not do inside a tick. The allocator and the pthread locks are
// interposed by this executable, other system calls are trapped by a seccomp filter on the thread.
struct Offences {
    std::uint64_t allocations = 0;  // malloc family, operator new and delete
    std::uint64_t locks = 0;        // pthread mutexes, read-write locks, spin locks, conditions
    std::uint64_t systemCalls = 0;  // but for futex
    std::uint64_t futexCalls = 0;   // some are meant to be: see mostFutexCalls()
    long firstSystemCall = -1;

    bool none() const { return allocations == 0 && locks == 0 && systemCalls == 0; }
    std::string text() const;
};

// Makes the calling thread a watched one, for the rest of its life. The filter lets pass
// clock_nanosleep and clock_gettime (the loop's sleep and clock) and what ends a thread. It counts
// futex, which wakes and waits; whatever else is counted and fails.
void watchThisThread();

// Whether the calling thread is inside a tick: only then offences count.
void enterTick();
void leaveTick();

Offences offences();  // of all threads since the last reset
void resetOffences();

// Page faults of all watched threads, minor and major, from the kernel's counters.
std::uint64_t pageFaults();

}  // namespace cortex::test
