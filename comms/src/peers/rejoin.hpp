// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

namespace cortex::comms {

// When to join the network anew. With security, who hears nobody for longer than a lease drops all
// others and meets them anew. Those that still hear it answer no second handshake of the same
// participant, so only another one is met. Who never heard anybody gets more time, as a first
// handshake may take long. Without security, somebody may have written in the name of others, so
// that what they write is skipped; only a new participant hears them again.
class Rejoin {
public:
    // `unheard`: somebody is found who does not prove who it is, or is skipped.
    bool isDue(bool hearsAny, bool unheard, std::int64_t now) {
        if (hearsAny) {
            pause_ = shortest;
            due_ = now;
        }
        if (hearsAny || !unheard) return false;
        if (due_ == never) due_ = now + shortest;
        if (now < due_) return false;
        due_ = now + pause_;
        pause_ = std::min(2 * pause_, longest);
        return true;
    }

private:
    // Longer each time, as a stranger proves nothing either.
    static constexpr std::int64_t shortest = 10'000'000'000, longest = 600'000'000'000;  // ns

    static constexpr std::int64_t never = -1;

    std::int64_t due_ = never, pause_ = shortest;
};

}  // namespace cortex::comms
