// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/event_count.hpp"

#include <cerrno>
#include <ctime>
#include <limits>

#include <linux/futex.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace cortex {

static_assert(sizeof(std::atomic<std::uint32_t>) == sizeof(std::uint32_t));
static_assert(std::atomic<std::uint32_t>::is_always_lock_free);

bool EventCount::sleepWhile(std::uint32_t value, std::int64_t until) noexcept {
    const std::uint32_t flagged = value | sleeper;
    std::uint32_t seen = value;
    if (!word_.compare_exchange_strong(seen, flagged, std::memory_order_acquire) &&
        seen != flagged) {
        return true;
    }
    return waitWhile(flagged, until);
}

void EventCount::napWhile(std::uint32_t value, std::int64_t until) noexcept {
    const std::uint32_t seen = word_.load(std::memory_order_acquire);
    if ((seen & ~sleeper) == value) waitWhile(seen, until);
}

bool EventCount::waitWhile(std::uint32_t word, std::int64_t until) noexcept {
    constexpr std::int64_t second = 1'000'000'000;
    const timespec time{static_cast<time_t>(until / second), static_cast<long>(until % second)};
    return ::syscall(SYS_futex, &word_, FUTEX_WAIT_BITSET_PRIVATE, word,
                     until <= 0 ? nullptr : &time, nullptr, FUTEX_BITSET_MATCH_ANY) == 0 ||
           errno != ETIMEDOUT;
}

void EventCount::clearAndWake() noexcept {
    word_.fetch_and(~sleeper, std::memory_order_acq_rel);
    wakeAll();
}

void EventCount::wakeAll() noexcept {
    ::syscall(SYS_futex, &word_, FUTEX_WAKE_PRIVATE, std::numeric_limits<int>::max(), nullptr,
              nullptr, 0);
}

void sleepPunctually() noexcept { prctl(PR_SET_TIMERSLACK, 1UL); }

}  // namespace cortex
