// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/realtime.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cortex {

// Bounded ring between one producer and one consumer thread; elements are filled and read in place.
template <class T>
class SpscRing {
public:
    explicit SpscRing(std::uint32_t capacity)
        : elements_(std::bit_ceil(std::max<std::size_t>(capacity, 1))) {}

    std::size_t size() const { return elements_.size(); }
    T& place(std::size_t index) { return elements_[index]; }  // setup

    // Producer: the element to fill, null when full; then push().
    T* free() CORTEX_REALTIME {
        const std::uint64_t tail = tail_.load(std::memory_order_relaxed);
        if (tail - head_.load(std::memory_order_acquire) == elements_.size()) return nullptr;
        return &elements_[tail & (elements_.size() - 1)];
    }
    void push() CORTEX_REALTIME {
        tail_.store(tail_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
    }

    // Consumer: the oldest element, null when empty; then pop().
    T* front() CORTEX_REALTIME {
        const std::uint64_t head = head_.load(std::memory_order_relaxed);
        if (head == tail_.load(std::memory_order_acquire)) return nullptr;
        return &elements_[head & (elements_.size() - 1)];
    }
    void pop() CORTEX_REALTIME {
        head_.store(head_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
    }

private:
    std::vector<T> elements_;
    alignas(64) std::atomic<std::uint64_t> head_{0};
    alignas(64) std::atomic<std::uint64_t> tail_{0};
};

}  // namespace cortex
