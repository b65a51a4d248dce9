// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_wake.hpp"

#include "agent/agent_self.hpp"

#include <algorithm>
#include <ctime>

#include <linux/futex.h>
#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace cortex::comms {
namespace {

// Of await(), ns. The lead grows where it woke up too late, and shrinks a tenth as fast where it
// was in time: nine times of ten it is, where timers are not later than the longest lead.
constexpr std::int64_t longestLead = 50'000, earlier = 5000, later = 500;
constexpr std::int64_t patience = 20'000;

}  // namespace

static_assert(sizeof(std::atomic<std::uint32_t>) == sizeof(std::uint32_t));
static_assert(std::atomic<std::uint32_t>::is_always_lock_free);

void Wake::waitUntil(std::int64_t time) noexcept { sleepUntil(Sleeping, time); }

bool Wake::await(std::int64_t time) noexcept {
    const std::int64_t now = steadyNow(), end = time + patience, wakeUp = time - lead_;
    if (now >= end) return false;
    const bool signalled = sleepUntil(Coming, wakeUp);
    if (steadyNow() < wakeUp) return true;  // woken before: by a signal, or for nothing
    if (signalled) {
        if (now < wakeUp) lead_ = std::min(lead_ + earlier, longestLead);
        return true;
    }
    while (word_.load() == Awake) {
        if (steadyNow() >= end) return false;
        sched_yield();  // the one that is awaited may need this CPU
    }
    lead_ = std::max<std::int64_t>(lead_ - later, 0);
    word_.exchange(Awake);
    return true;
}

// True: it was signalled.
bool Wake::sleepUntil(Word how, std::int64_t time) noexcept {
    std::uint32_t seen = Awake;
    if (word_.compare_exchange_strong(seen, how)) {
        constexpr std::int64_t perSecond = 1'000'000'000;
        const timespec until{time / perSecond, time % perSecond};
        ::syscall(SYS_futex, &word_, FUTEX_WAIT_BITSET_PRIVATE, how, &until, nullptr,
                  FUTEX_BITSET_MATCH_ANY);
    }
    return (word_.exchange(Awake) & Signalled) != 0;  // and sees what was done before the signal
}

void Wake::wakeSleeper() noexcept {
    ::syscall(SYS_futex, &word_, FUTEX_WAKE_PRIVATE, 1, nullptr, nullptr, 0);
}

}  // namespace cortex::comms
