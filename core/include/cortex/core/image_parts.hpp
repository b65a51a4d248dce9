// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/tables.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cortex {

// Who copies what of the tables into an image. The data of an active simplex is written by its own
// task alone: the thread that has run a group of tasks copies it while it has it in its caches,
// where it lies together. The rest is copied at the end of the cycle.
struct ImageParts {
    struct Part {
        std::size_t offset = 0, octets = 0;  // of the arena
    };
    std::vector<Part> parts;          // group after group
    std::vector<std::uint32_t> ends;  // of each group in `parts`
    std::vector<Part> rest;           // but for the texts, which hardly ever change

    // Nothing where there is no such group.
    std::span<const Part> of(std::uint32_t group) const CORTEX_REALTIME {
        if (group >= ends.size()) return {};
        const std::uint32_t first = group == 0 ? 0 : ends[group - 1];
        return {parts.data() + first, ends[group] - first};
    }
};

// Setup. `groups`: simplexes whose tasks run one after the other, each in one group at most.
ImageParts divideImage(const Tables& tables,
                       std::span<const std::span<const std::uint32_t>> groups);

}  // namespace cortex
