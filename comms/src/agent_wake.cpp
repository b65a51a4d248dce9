// SPDX-License-Identifier: Apache-2.0
#include "agent_wake.hpp"

#include <ctime>

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace cortex::comms {

static_assert(sizeof(std::atomic<std::uint32_t>) == sizeof(std::uint32_t));
static_assert(std::atomic<std::uint32_t>::is_always_lock_free);

void Wake::waitFor(std::chrono::nanoseconds limit) noexcept {
    std::uint32_t seen = Awake;
    if (word_.compare_exchange_strong(seen, Sleeping)) {
        constexpr std::int64_t perSecond = 1'000'000'000;
        const timespec timeout{limit.count() / perSecond, limit.count() % perSecond};
        ::syscall(SYS_futex, &word_, FUTEX_WAIT_PRIVATE, Sleeping, &timeout, nullptr, 0);
    }
    word_.exchange(Awake);  // and sees what was done before the signal
}

void Wake::wakeSleeper() noexcept {
    ::syscall(SYS_futex, &word_, FUTEX_WAKE_PRIVATE, 1, nullptr, nullptr, 0);
}

}  // namespace cortex::comms
