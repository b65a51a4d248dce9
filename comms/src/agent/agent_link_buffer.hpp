// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/transport.hpp"

#include "wire/simplex_values.hpp"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

namespace cortex::comms {

// Carries the samples of all simplexes that are linked from one other agent into the loop; the
// newest win. All that the loop takes at once was published at once. One writer thread and one
// reader thread use it, and both are wait-free.
class LinkBuffer {
public:
    struct Sample {
        explicit Sample(const TypeLayout& layout) : values{layout} {}
        void copy(const Sample& other);

        SliceMemory values;
        std::uint64_t number = 0;  // it grows with each sample; 0: none has come
        std::int64_t age = 0;      // ns, when it was sent
        std::int64_t came = 0;     // monotonicNow()
    };
    using Samples = std::deque<Sample>;  // by place

    explicit LinkBuffer(const std::vector<const TypeLayout*>& layouts);

    // To be filled anew; the others stay as they are.
    Sample& writable(std::size_t place) { return samples_[back_][place]; }
    void publish();
    const Sample& published(std::size_t place) const { return samples_[newest_][place]; }

    // Valid until the next call.
    const Samples& take() CORTEX_REALTIME {
        if ((middle_.load() & fresh) != 0) front_ = middle_.exchange(front_) & which;
        return samples_[front_];
    }

private:
    static constexpr std::uint32_t which = 3, fresh = 4;

    std::array<Samples, 3> samples_;
    std::uint32_t back_ = 0, newest_ = 2;  // the writer's
    std::uint32_t front_ = 1;              // the reader's
    std::atomic<std::uint32_t> middle_{2};
};

inline void LinkBuffer::Sample::copy(const Sample& other) {
    values.copy(other.values);
    number = other.number;
    age = other.age;
    came = other.came;
}

inline LinkBuffer::LinkBuffer(const std::vector<const TypeLayout*>& layouts) {
    for (Samples& samples : samples_) {
        for (const TypeLayout* layout : layouts) samples.emplace_back(*layout);
    }
}

// What was published last is only read: by the reader, and here.
inline void LinkBuffer::publish() {
    for (std::size_t i = 0; i < samples_[back_].size(); ++i) {
        Sample& sample = samples_[back_][i];
        if (sample.number < published(i).number) sample.copy(published(i));
    }
    newest_ = back_;
    back_ = middle_.exchange(back_ | fresh) & which;
}

}  // namespace cortex::comms
