// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace cortex::profiler {

// The limit of an image: std::memcpy (https://en.cppreference.com/w/cpp/string/byte/memcpy) of the
// same octets into memory that has been touched before.
class PlainMemcpy {
public:
    explicit PlainMemcpy(std::span<const std::byte> from) : from_{from}, to_(from.size()) {}

    void copies(std::int64_t count) {
        for (std::int64_t i = 0; i < count; ++i) {
            std::memcpy(to_.data(), from_.data(), from_.size());
            asm volatile("" : : "r"(to_.data()) : "memory");
        }
    }

private:
    std::span<const std::byte> from_;
    std::vector<std::byte> to_;
};

}  // namespace cortex::profiler
