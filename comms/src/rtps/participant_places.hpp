// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/agreement.hpp"

#include "rtps/participant_limits.hpp"
#include "rtps/recent_table.hpp"
#include "rtps/submessages.hpp"

#include <array>
#include <cstdint>

namespace cortex::comms::rtps {

// Where participants are reached. Fast DDS believes each announcement, and forgets a participant
// that is said to end: so a forged goodbye and a forged announcement with wrong addresses would
// part two agents. A participant of CorteX keeps its addresses; where they change, it joins anew
// under another id. So those of the first announcement hold, also for a lease after it was heard
// last. Fast DDS 2.9 may name more behind them later, and the group. One thread at a time.
class ParticipantPlaces {
public:
    using Counts = std::array<std::uint8_t, 3>;  // of kinds of addresses
    struct Places {
        Counts counts{};
        TypeHash hash{};
        bool operator==(const Places&) const = default;
    };

    // `isRelayed`: a Discovery Server passes on what participants say.
    ParticipantPlaces(int domain, bool isRelayed)
        : isRelayed_{isRelayed}, groupPort_{7400 + 250 * static_cast<std::uint32_t>(domain)} {}

    // Of a DATA whose content was judged, from an IPv4 address: None, or Places.
    Refusal judge(const Submessage& data, const Prefix& sender, std::uint32_t address,
                  std::int64_t now);

private:
    const bool isRelayed_;
    const std::uint32_t groupPort_;  // RTPS 2.3, 9.6.1.1
    struct First {
        Places places;
        std::uint32_t address = 0;  // that it came from
    };
    RecentTable<Prefix, First> known_{4 * ParticipantLimits::most};
};

}  // namespace cortex::comms::rtps
