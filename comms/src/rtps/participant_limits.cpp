// SPDX-License-Identifier: Apache-2.0
#include "rtps/participant_limits.hpp"

namespace cortex::comms::rtps {

bool ParticipantLimits::admits(const Prefix& participant, std::uint32_t address, std::int64_t now) {
    if (auto* const known = heard_.find(participant)) {
        known->met = now;
        return true;
    }
    std::size_t all = 0, ofAddress = 0;
    for (const auto& place : heard_.places()) {
        if (!place || now - place->met > patience) continue;
        ++all;
        if (place->value == address) ++ofAddress;
    }
    auto& place = heard_.placeFor(participant);
    const bool isTaken = place && now - place->met <= patience;
    if (all >= most || ofAddress >= mostOfAddress || isTaken) return false;
    place = {participant, now, address};
    return true;
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
