// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/realtime.hpp"

#include <atomic>
#include <cstdint>

namespace cortex {

// An even number that some threads change and others wait for. To change it costs a system call
// only where a thread sleeps for it. It never allocates or locks, which the standard's atomic wait
// may do.
//
// **Invariants**
// 1. The upper 31 bits of the word are the number; the lowest bit says that a thread sleeps.
// 2. A thread sleeps only after it has set that bit in the same atomic step in which it saw the
//    number that it waits to change. So a thread that changes the number afterwards finds the bit.
// 3. The kernel compares the word once more before it lets the thread sleep. A change between the
//    two steps therefore ends the wait at once.
// 4. Whoever changes the number clears the bit and, if it was set, wakes all threads: none stays
//    asleep after its bit was cleared. The bit may outlive a sleeper whose time has come; that
//    costs one call that wakes nobody.
// 5. A thread that naps sets no bit. So advance() and publish() leave it asleep unless another
//    thread sleeps as well, and it finds the new number when its time has come. wake() ends a nap.
// 6. What a thread wrote before it changed the number is seen by every thread that saw the change.
// 7. Any wait may end early. Callers look at the number again.
// 8. publish() is for one thread that alone decides the number; it must not be mixed with
//    advance() or wake() of other threads.
class EventCount {
public:
    std::uint32_t value() const noexcept CORTEX_REALTIME {
        return word_.load(std::memory_order_acquire) & ~sleeper;
    }

    // `value` is even.
    void publish(std::uint32_t value) noexcept CORTEX_REALTIME {
        if ((word_.exchange(value, std::memory_order_acq_rel) & sleeper) != 0) wakeAll();
    }
    // Moves on to the next even number; any thread.
    void advance() noexcept CORTEX_REALTIME {
        if ((word_.fetch_add(step, std::memory_order_seq_cst) & sleeper) != 0) clearAndWake();
    }
    // As advance(), and wakes threads that nap as well: always a system call.
    void wake() noexcept CORTEX_REALTIME {
        word_.fetch_add(step, std::memory_order_seq_cst);
        clearAndWake();
    }

    // Returns when the value may have changed, sometimes earlier. False: since it is `until`, ns of
    // the monotonic clock (0 or less: never).
    bool sleepWhile(std::uint32_t value, std::int64_t until = 0) noexcept;
    // The same for a thread that comes by itself at `until`, so that advance() need not wake it.
    void napWhile(std::uint32_t value, std::int64_t until) noexcept;

    static constexpr std::uint32_t step = 2;

private:
    static constexpr std::uint32_t sleeper = 1;

    void clearAndWake() noexcept CORTEX_REALTIME;
    void wakeAll() noexcept CORTEX_REALTIME;
    bool waitWhile(std::uint32_t word, std::int64_t until) noexcept;

    std::atomic<std::uint32_t> word_{0};
};

// From now on timed waits of the calling thread end when they should, not up to 50 us later.
void sleepPunctually() noexcept;

}  // namespace cortex
