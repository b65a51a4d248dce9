// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rtps/recent_table.hpp"
#include "rtps/refusal.hpp"

#include <array>
#include <cstdint>

namespace cortex::comms::rtps {

using Prefix = std::array<std::uint8_t, 12>;  // of a participant

// Bounds how many participants an address, and all together, may have: each one that Fast DDS
// knows costs memory and time. A participant that was silent for 15 s makes room where it is
// needed. So those that are refused come in once a flood is over. One thread at a time.
//
// Fast DDS 2.9 may drop a participant whose lease ends while it meets it anew: it then knows it
// without endpoints, for ever. So who was silent for a lease is let in a second after its end.
class ParticipantLimits {
public:
    static constexpr std::size_t mostOfAddress = 400, most = 1024;
    static constexpr std::int64_t patience = 15'000'000'000;  // ns

    // None, Participants or Early.
    Refusal judge(const Prefix& participant, std::uint32_t address, std::int64_t now);
    bool isHeard(const Prefix& participant, std::int64_t now) const;   // within that time
    bool isSilent(const Prefix& participant, std::int64_t now) const;  // it was heard before

private:
    struct Heard {
        std::uint32_t address;
        std::int64_t notBefore = 0;  // it is let in
    };
    RecentTable<Prefix, Heard> heard_{4 * most};
};

}  // namespace cortex::comms::rtps
