// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/transport.hpp"

#include "wire/simplex_values.hpp"

#include <array>
#include <atomic>
#include <cstdint>

namespace cortex::comms {

// Carries the samples of one linked simplex into the loop; the newest wins. One writer thread and
// one reader thread use it, and both are wait-free.
class LinkBuffer {
public:
    struct Sample {
        explicit Sample(const TypeLayout& layout) : values{layout} {}

        SliceMemory values;
        std::int64_t age = 0;   // ns, when it was sent
        std::int64_t came = 0;  // monotonicNow()
    };

    explicit LinkBuffer(const TypeLayout& layout)
        : samples_{Sample{layout}, Sample{layout}, Sample{layout}} {}

    Sample& writable() { return samples_[back_]; }
    void publish() { back_ = middle_.exchange(back_ | fresh) & place; }

    // The newest sample, each only once. Null: none has come since the last call. Valid until the
    // next call.
    const Sample* take() CORTEX_REALTIME {
        if ((middle_.load() & fresh) == 0) return nullptr;
        front_ = middle_.exchange(front_) & place;
        return &samples_[front_];
    }

private:
    static constexpr std::uint32_t place = 3, fresh = 4;

    std::array<Sample, 3> samples_;
    std::uint32_t back_ = 0;   // the writer's
    std::uint32_t front_ = 1;  // the reader's
    std::atomic<std::uint32_t> middle_{2};
};

}  // namespace cortex::comms
