// SPDX-License-Identifier: Apache-2.0
#include "wake_word.hpp"

#include <limits>

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace cortex::cs {

static_assert(sizeof(std::atomic<std::uint32_t>) == sizeof(std::uint32_t));
static_assert(std::atomic<std::uint32_t>::is_always_lock_free);

void WakeWord::sleepWhile(std::uint32_t value) noexcept {
    const std::uint32_t flagged = value | Sleeper;
    std::uint32_t seen = value;
    if (!word_.compare_exchange_strong(seen, flagged, std::memory_order_acquire) &&
        seen != flagged) {
        return;
    }
    // Wrong value, signal, wake: whatever ends it, the caller looks again.
    ::syscall(SYS_futex, &word_, FUTEX_WAIT_PRIVATE, flagged, nullptr, nullptr, 0);
}

void WakeWord::wakeAll() noexcept {
    ::syscall(SYS_futex, &word_, FUTEX_WAKE_PRIVATE, std::numeric_limits<int>::max(), nullptr,
              nullptr, 0);
}

}  // namespace cortex::cs
