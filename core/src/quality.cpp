// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/quality.hpp"

#include <array>
#include <cstddef>

namespace cortex {

const char* name(Quality quality) {
    static constexpr std::array names{"good", "stale", "bad", "lost"};
    return names[static_cast<std::size_t>(quality)];
}

}  // namespace cortex
