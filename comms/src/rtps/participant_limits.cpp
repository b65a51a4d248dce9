// SPDX-License-Identifier: Apache-2.0
#include "rtps/participant_limits.hpp"

#include "wire/presence_interval.hpp"

#include <algorithm>

namespace cortex::comms::rtps {
namespace {

constexpr std::int64_t around = 1'000'000'000;  // ns before and after the end of a lease

}  // namespace

Refusal ParticipantLimits::judge(const Prefix& participant, std::uint32_t address,
                                 std::int64_t now) {
    if (auto* const known = heard_.find(participant)) {
        std::int64_t& notBefore = known->value.notBefore;
        const std::int64_t end = known->met + leaseOfParticipant;
        if (notBefore == 0 && now >= end - around) notBefore = std::max(now, end) + around;
        if (now < notBefore) return Refusal::Early;
        notBefore = 0;
        known->met = now;
        return Refusal::None;
    }
    std::size_t all = 0, ofAddress = 0;
    for (const auto& place : heard_.places()) {
        if (!place || now - place->met > patience) continue;
        ++all;
        if (place->value.address == address) ++ofAddress;
    }
    auto& place = heard_.placeFor(participant);
    const bool isTaken = place && now - place->met <= patience;
    if (all >= most || ofAddress >= mostOfAddress || isTaken) return Refusal::Participants;
    place = {participant, now, {address}};
    return Refusal::None;
}

bool ParticipantLimits::isHeard(const Prefix& participant, std::int64_t now) const {
    const auto* const known = heard_.find(participant);
    return known != nullptr && now - known->met <= patience;
}

bool ParticipantLimits::isSilent(const Prefix& participant, std::int64_t now) const {
    const auto* const known = heard_.find(participant);
    return known != nullptr && now - known->met > patience;
}

}  // namespace cortex::comms::rtps
