// SPDX-License-Identifier: Apache-2.0
#include "threads/wake_word.hpp"

#include <cerrno>
#include <ctime>
#include <limits>

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace cortex::cs {

static_assert(sizeof(std::atomic<std::uint32_t>) == sizeof(std::uint32_t));
static_assert(std::atomic<std::uint32_t>::is_always_lock_free);

bool WakeWord::sleepWhile(std::uint32_t value, std::int64_t until) noexcept {
    const std::uint32_t flagged = value | Sleeper;
    std::uint32_t seen = value;
    if (!word_.compare_exchange_strong(seen, flagged, std::memory_order_acquire) &&
        seen != flagged) {
        return true;
    }
    constexpr std::int64_t second = 1'000'000'000;
    const timespec time{static_cast<time_t>(until / second), static_cast<long>(until % second)};
    // Wrong value, signal, wake: whatever else ends it, the caller looks again.
    return ::syscall(SYS_futex, &word_, FUTEX_WAIT_BITSET_PRIVATE, flagged,
                     until <= 0 ? nullptr : &time, nullptr, FUTEX_BITSET_MATCH_ANY) == 0 ||
           errno != ETIMEDOUT;
}

void WakeWord::wakeAll() noexcept {
    ::syscall(SYS_futex, &word_, FUTEX_WAKE_PRIVATE, std::numeric_limits<int>::max(), nullptr,
              nullptr, 0);
}

}  // namespace cortex::cs
