// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/image.hpp"
#include "cortex/core/spsc_ring.hpp"
#include "cortex/core/tables.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace cortex {

// How many images of so many octets an interface keeps for those who ask for every cycle: 32, or
// fewer where they are large, so that they take 4 MiB, but at least 4. A power of two.
std::uint32_t imagesToKeep(std::size_t octets);

// Fixed pool of images: the tables as they were at the end of cycles.
//
// **Invariants**
// 1. There are `readers` + 2 slots: the newest, one for each reader, and the next one to fill.
// 2. The loop's thread alone fills slots and moves `newest_`. It never waits for a reader.
// 3. It fills only a slot that is neither the newest nor pinned, and that it chose after the slot
//    before had become the newest.
// 4. A reader pins a slot and then looks whether it is still the newest. If not, it lets go of the
//    slot and tries again; it reads nothing before that second look.
// 5. Pins and `newest_` are sequentially consistent. So either the loop sees the pin of a slot that
//    it is about to choose, or the reader sees that another slot is the newest.
// 6. A reader takes a place among `readers` before it pins, and pins one slot at a time. So the
//    loop always finds a free one among the `readers` + 1 that are not the newest.
// 7. A slot is complete before it becomes the newest, and does not change while it is pinned.
// 8. The follower's images have places among `readers`, too: the loop takes one for each image that
//    it queues. Without one, or with a full queue, that image is lost to the follower, and counted.
// 9. Texts are copied into a slot only if some text has changed since they were copied into it.
class ImagePool {
public:
    ImagePool(Tables& tables, std::uint32_t readers);

    // Loop thread, once at the end of a cycle: copies what all tasks have written.
    void publish(std::int64_t cycle, std::int64_t nominalTime, std::int64_t wallClock)
        CORTEX_REALTIME;

    // Pins the newest image. Empty if `readers` images are already pinned.
    Image newest() CORTEX_REALTIME;
    std::int64_t newestCycle() const { return cycle_.load(std::memory_order_acquire); }
    std::size_t octetsOfImage() const { return tables_.arena().size(); }

    // Setup, once, before the loop runs and while no image is held: from now on every image is
    // queued for one reader, up to `depth` of them. Throws Error.
    void follow(std::uint32_t depth = 8);
    // The follower's thread: the next image in the order of cycles; empty: none yet.
    Image next() CORTEX_REALTIME;
    std::uint64_t lost() const {
        return lost_.load(std::memory_order_relaxed);
    }  // to it; any thread

private:
    friend class Image;
    struct alignas(64) Slot {
        std::atomic<std::uint32_t> pins{0};
        std::int64_t cycle = 0, nominalTime = 0, wallClock = 0;
        std::byte* memory = nullptr;
        std::uint64_t textChanges = ~std::uint64_t{0};  // when its texts were copied; none yet
    };
    void makeSlots();
    void copyTables(Slot& slot) CORTEX_REALTIME;
    void queue(std::uint32_t slot) CORTEX_REALTIME;

    Tables& tables_;
    std::uint32_t readers_;
    std::unique_ptr<std::byte[]> memory_;
    std::unique_ptr<Slot[]> slots_;
    std::uint32_t next_ = 0;  // the slot that is filled next
    std::atomic<std::uint32_t> newest_{0};
    std::atomic<std::uint32_t> pinned_{0};
    std::atomic<std::int64_t> cycle_{0};
    std::unique_ptr<SpscRing<std::uint32_t>> followed_;  // slots; null: nobody follows
    std::atomic<std::uint64_t> lost_{0};
};

}  // namespace cortex
