// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>

namespace cortex::cs {

/// An even number that one thread publishes and others wait for; its lowest bit says that somebody
/// sleeps, so publishing costs a system call only then. Never allocates, never locks (the
/// standard's atomic wait may do both).
class WakeWord {
public:
    std::uint32_t value() const noexcept {
        return word_.load(std::memory_order_acquire) & ~Sleeper;
    }

    /// True where it had to wake somebody.
    bool publish(std::uint32_t value) noexcept {
        const bool wakes = (word_.exchange(value, std::memory_order_acq_rel) & Sleeper) != 0;
        if (wakes) wakeAll();
        return wakes;
    }

    /// Moves on to the next even number, from whatever threads.
    void advance() noexcept {
        if ((word_.fetch_add(2, std::memory_order_seq_cst) & Sleeper) == 0) return;
        word_.fetch_and(~Sleeper, std::memory_order_acq_rel);
        wakeAll();
    }

    /// Returns when the value may have changed, sometimes earlier. False: since it is `until`, ns
    /// of the monotonic clock (0 or less: never).
    bool sleepWhile(std::uint32_t value, std::int64_t until = 0) noexcept;

private:
    static constexpr std::uint32_t Sleeper = 1;

    void wakeAll() noexcept;

    std::atomic<std::uint32_t> word_{0};
};

}  // namespace cortex::cs
