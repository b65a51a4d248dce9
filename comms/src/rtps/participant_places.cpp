// SPDX-License-Identifier: Apache-2.0
#include "rtps/participant_places.hpp"

#include "rtps/parameters.hpp"
#include "wire/presence_interval.hpp"

#include <algorithm>
#include <span>
#include <string>

namespace cortex::comms::rtps {
namespace {

// Identifiers of parameters: RTPS 2.3, 9.6.3.
constexpr std::uint16_t participantGuid = 0x0050, sentinel = 0x0001;
constexpr std::uint16_t unicastIds[] = {0x002f, 0x0031, 0x0032},
                        groupIds[] = {0x0030, 0x0033, 0x0048};
constexpr std::uint32_t udpV4 = 1, loopback = 127, groupOfDiscovery = 0xefff0001;

// What an announcement says of where a participant is.
struct Places {
    Prefix participant{};
    TypeHash hash{};         // of its own addresses
    bool hasSender = false;  // among them, the address that it came from
    bool isOfGroup = true;   // it is in no other group than that for discovery of its domain
};

bool isOneOf(std::span<const std::uint16_t> ids, std::uint16_t id) {
    return std::ranges::find(ids, id) != ids.end();
}

struct Locator {
    std::uint32_t kind = 0, port = 0, address = 0;
};

Locator locatorIn(Bytes content, bool little) {
    constexpr std::size_t size = 24;
    if (content.size() < size) return {};
    return {readU32(content, little), readU32(content.subspan(4), little),
            readU32(content.subspan(20), false)};
}

Places placesIn(Bytes parameters, bool little, std::uint32_t address, std::uint32_t port) {
    Places places;
    const Bytes guid = parameterOf(parameters, little, participantGuid);
    if (guid.size() >= places.participant.size())
        std::copy_n(guid.begin(), places.participant.size(), places.participant.begin());
    places.hasSender = address >> 24 == loopback;
    std::string text;
    for (std::size_t at = 0; at + 4 <= parameters.size();) {
        const std::uint16_t id = readU16(parameters.subspan(at), little);
        const std::size_t size = readU16(parameters.subspan(at + 2), little);
        if (id == sentinel || size > parameters.size() - at - 4) break;
        const Bytes whole = parameters.subspan(at, 4 + size);
        at += whole.size();
        const Locator locator = locatorIn(whole.subspan(4), little);
        if (isOneOf(groupIds, id))
            places.isOfGroup = places.isOfGroup && locator.kind == udpV4 &&
                               locator.address == groupOfDiscovery && locator.port == port;
        if (!isOneOf(unicastIds, id)) continue;
        text.append(whole.begin(), whole.end());
        places.hasSender =
            places.hasSender || (locator.kind == udpV4 && locator.address == address);
    }
    places.hash = hashOf(text);
    return places;
}

}  // namespace

Refusal ParticipantPlaces::judge(const Submessage& data, const Prefix& sender,
                                 std::uint32_t address, std::int64_t now) {
    const bool hasData = (data.flags & 4) != 0;
    if (!hasData || readU32(data.body.subspan(8), false) != announcesParticipants)
        return Refusal::None;
    const Bytes payload = partsOf(data).payload;
    const bool little = (payload[1] & 1) != 0;
    const Places said = placesIn(payload.subspan(4), little, address, groupPort_);
    if (!said.isOfGroup || (!isRelayed_ && said.participant != sender)) return Refusal::Places;
    auto* const known = known_.find(said.participant);
    if (known == nullptr) {
        known_.placeFor(said.participant) = {said.participant, now, {said.hash, address}};
        return Refusal::None;
    }
    if (now - known->met > leaseOfParticipant) known->value = {said.hash, address};
    const bool isItsOwn = isRelayed_ || said.hasSender || address == known->value.address;
    if (said.hash != known->value.hash || !isItsOwn) return Refusal::Places;
    known->met = now;
    return Refusal::None;
}

}  // namespace cortex::comms::rtps
