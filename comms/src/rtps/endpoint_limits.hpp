// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rtps/participant_limits.hpp"
#include "rtps/writer_numbers.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace cortex::comms::rtps {

// Bounds how many endpoints of topics of CorteX a participant, and all together, may announce: Fast
// DDS keeps what it is told of each, 2 kB, also where nothing here is connected with it. Those of
// participants that were silent for a while make room where it is needed. One thread at a time.
class EndpointLimits {
public:
    static constexpr std::size_t mostOfParticipant = 512, most = 8192;

    // Whether a participant may announce this endpoint, which may be known already.
    bool admits(const WriterGuid& endpoint, const ParticipantLimits& heard, std::int64_t now);
    void remove(const WriterGuid& endpoint);

private:
    void forgetSilent(const ParticipantLimits& heard, std::int64_t now);

    std::map<Prefix, std::vector<std::uint32_t>> announced_;  // ids of entities
    std::size_t all_ = 0;
    std::int64_t lookedAt_ = 0;  // for silent participants, ns
};

}  // namespace cortex::comms::rtps
