// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace cortex {

// How far the data of a simplex can be trusted; greater is worse.
enum class Quality : std::uint8_t { Good, Stale, Bad, Lost };

const char* name(Quality quality);  // "good", "stale", "bad", "lost"
std::optional<Quality> qualityFromName(std::string_view text);

inline constexpr std::uint32_t noSimplex = 0xffffffffU;

// Quality of a simplex and stamp of the oldest measurement in it. Set by the framework after each
// task; the task may override.
struct SlotState {
    std::int64_t cycle = 0;           // owner's cycle of the oldest measurement
    std::int64_t time = 0;            // its nominal time, ns since the cluster's start
    std::uint32_t cause = noSimplex;  // index of the simplex that first made it not good
    Quality quality = Quality::Good;
    std::array<std::uint8_t, 3> unused{};  // no padding: equal states are equal bytes

    bool operator==(const SlotState&) const = default;
};

}  // namespace cortex
