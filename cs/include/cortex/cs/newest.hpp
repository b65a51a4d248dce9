// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/realtime.hpp"

#include <array>
#include <atomic>
#include <type_traits>

namespace cortex::cs {

// The newest value from one thread to another one. Neither waits for the other.
//
// **Invariants**
// 1. Of the three slots one belongs to the writer, one to the reader, one lies between them. Which
//    one lies there is in `between_`; each side keeps the number of its own to itself.
// 2. A side gets another slot only by exchanging its own for the one between, in one atomic step.
//    So no slot ever belongs to two, and each of the three always belongs to somebody.
// 3. put() writes only the writer's slot and then exchanges it; the bit `isNew` goes with it.
// 4. take() exchanges only where that bit is set, and what it leaves between has no such bit. So
//    the reader never gets a value that it had before.
// 5. The exchange releases what was written and acquires what the other side has done with the
//    slot: a value is seen whole, and a slot is written after its reader has let go of it.
// 6. Values that are not taken in time are replaced by newer ones; the newest one is never lost.
// 7. One thread at a time writes, and one reads; each step is bounded.
template <class T>
class Newest {
    static_assert(std::is_trivially_copyable_v<T>, "values are plain structs, copied whole");

public:
    void put(const T& value) CORTEX_REALTIME {
        slots_[written_].value = value;
        const unsigned offered = written_ | isNew;
        written_ = between_.exchange(offered, std::memory_order_acq_rel) & ~isNew;
    }
    // True: value() is another one now.
    bool take() CORTEX_REALTIME {
        if ((between_.load(std::memory_order_relaxed) & isNew) == 0) return false;
        read_ = between_.exchange(read_, std::memory_order_acq_rel) & ~isNew;
        return true;
    }
    const T& value() const CORTEX_REALTIME { return slots_[read_].value; }  // reader

private:
    static constexpr unsigned isNew = 4;
    struct alignas(64) Slot {
        T value{};
    };
    std::array<Slot, 3> slots_{};
    alignas(64) unsigned written_ = 0;
    alignas(64) std::atomic<unsigned> between_{1};
    alignas(64) unsigned read_ = 2;
};

}  // namespace cortex::cs
