// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/realtime.hpp"

#include <atomic>
#include <cstdint>

namespace cortex::comms {

// Wakes the one thread that waits: a system call only where it sleeps. Never allocates or locks.
class Wake {
public:
    void signal() noexcept CORTEX_REALTIME {
        if (word_.exchange(Signalled) > Signalled) wakeSleeper();
    }
    // From who is awaited: who wakes up for it by himself is left to do so.
    void signalAwaited() noexcept CORTEX_REALTIME {
        if (word_.fetch_or(Signalled) == Sleeping) wakeSleeper();
    }

    // Returns after a signal() since the last return, or at `time` (steadyNow()); sometimes
    // earlier.
    void waitUntil(std::int64_t time) noexcept;

    // For a signalAwaited() that is expected at `time` (steadyNow()): wakes up a little before it
    // and polls until a little after it. True: some signal came, or it woke up for nothing. False,
    // perhaps at once: none did by then.
    bool await(std::int64_t time) noexcept;

    // Or is about to.
    bool isSleeping() const noexcept { return word_.load() >= Sleeping; }

private:
    enum Word : std::uint32_t { Awake = 0, Signalled = 1, Sleeping = 2, Coming = 4 };

    bool sleepUntil(Word how, std::int64_t time) noexcept;
    void wakeSleeper() noexcept CORTEX_REALTIME;

    std::atomic<std::uint32_t> word_{Awake};
    std::int64_t lead_ = 0;  // ns that await() wakes up before the time; the waiting thread's
};

}  // namespace cortex::comms
