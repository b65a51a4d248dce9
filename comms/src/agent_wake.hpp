// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/realtime.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>

namespace cortex::comms {

// Wakes the one thread that waits: a system call only where it sleeps. Never allocates or locks.
class Wake {
public:
    void signal() noexcept CORTEX_REALTIME {
        if (word_.exchange(Signalled) == Sleeping) wakeSleeper();
    }
    // Returns after a signal() since the last return, or after `limit`; sometimes earlier.
    void waitFor(std::chrono::nanoseconds limit) noexcept;

private:
    enum Word : std::uint32_t { Awake, Signalled, Sleeping };

    void wakeSleeper() noexcept CORTEX_REALTIME;

    std::atomic<std::uint32_t> word_{Awake};
};

}  // namespace cortex::comms
