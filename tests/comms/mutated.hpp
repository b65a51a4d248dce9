// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace cortex::comms {

// One to four changes: an octet, a number, an end, a repetition.
inline std::vector<std::uint8_t> mutated(std::vector<std::uint8_t> payload,
                                         std::mt19937_64& random) {
    const auto below = [&](std::size_t end) { return static_cast<std::size_t>(random() % end); };
    for (std::size_t changes = 1 + below(4); changes > 0 && payload.size() > 8; --changes) {
        const std::size_t place = below(payload.size());
        const auto at = payload.begin() + static_cast<std::ptrdiff_t>(place);
        switch (below(5)) {
            case 0:
                *at ^= static_cast<std::uint8_t>(1U << below(8));
                break;
            case 1:
                *at = static_cast<std::uint8_t>(random());
                break;
            case 2:
                std::fill(at,
                          at + static_cast<std::ptrdiff_t>(
                                   std::min<std::size_t>(4, payload.size() - place)),
                          std::uint8_t{0xff});
                break;
            case 3:
                payload.resize(place);
                break;
            default:
                const std::vector<std::uint8_t> copy{
                    at, at + static_cast<std::ptrdiff_t>(
                                 std::min<std::size_t>(16, payload.size() - place))};
                payload.insert(at, copy.begin(), copy.end());
        }
    }
    return payload;
}

}  // namespace cortex::comms
