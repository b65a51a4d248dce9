// SPDX-License-Identifier: Apache-2.0
#include "rtps/participant_places.hpp"

#include "rtps/parameters.hpp"
#include "wire/presence_interval.hpp"

#include <algorithm>
#include <iterator>
#include <string>

namespace cortex::comms::rtps {
namespace {

// Identifiers of parameters: RTPS 2.3, 9.6.3.
constexpr std::uint16_t participantGuid = 0x0050, sentinel = 0x0001;
constexpr std::uint16_t ownIds[] = {0x002f, 0x0031, 0x0032}, groupIds[] = {0x0030, 0x0033, 0x0048};
constexpr std::uint32_t udpV4 = 1, loopback = 127, groupOfDiscovery = 0xefff0001;

// What an announcement says of where a participant is.
struct Said {
    Prefix participant{};
    ParticipantPlaces::Places places;
    bool hasSender = false;  // among them, the address that it came from
    bool isOfGroup = true;   // it is in no other group than that for discovery of its domain
};

struct Locator {
    std::uint32_t kind = 0, port = 0, address = 0;
};

Locator locatorIn(Bytes content, bool little) {
    constexpr std::size_t size = 24;
    if (content.size() < size) return {};
    return {readU32(content, little), readU32(content.subspan(4), little),
            readU32(content.subspan(20), false)};
}

// At most so many places of each kind are looked at.
Said read(Bytes parameters, bool little, std::uint32_t address, std::uint32_t port,
          const ParticipantPlaces::Counts& most) {
    Said said;
    const Bytes guid = parameterOf(parameters, little, participantGuid);
    if (guid.size() >= said.participant.size())
        std::copy_n(guid.begin(), said.participant.size(), said.participant.begin());
    said.hasSender = address >> 24 == loopback;
    std::string text;
    for (std::size_t at = 0; at + 4 <= parameters.size();) {
        const std::uint16_t id = readU16(parameters.subspan(at), little);
        const std::size_t size = readU16(parameters.subspan(at + 2), little);
        if (id == sentinel || size > parameters.size() - at - 4) break;
        const Bytes whole = parameters.subspan(at, 4 + size);
        at += whole.size();
        const Locator locator = locatorIn(whole.subspan(4), little);
        if (std::ranges::find(groupIds, id) != std::end(groupIds))
            said.isOfGroup = said.isOfGroup && locator.kind == udpV4 &&
                             locator.address == groupOfDiscovery && locator.port == port;
        const auto* const kind = std::ranges::find(ownIds, id);
        if (kind == std::end(ownIds)) continue;
        const auto place = static_cast<std::size_t>(kind - std::begin(ownIds));
        std::uint8_t& count = said.places.counts[place];
        if (count == most[place] && count > 0) continue;
        ++count;
        text.append(whole.begin(), whole.end());
        said.hasSender = said.hasSender || (locator.kind == udpV4 && locator.address == address);
    }
    said.places.hash = hashOf(text);
    return said;
}

}  // namespace

Refusal ParticipantPlaces::judge(const Submessage& data, const Prefix& sender,
                                 std::uint32_t address, std::int64_t now) {
    const bool hasData = (data.flags & 4) != 0;
    if (!hasData || readU32(data.body.subspan(8), false) != announcesParticipants)
        return Refusal::None;
    const Bytes payload = partsOf(data).payload;
    const bool little = (payload[1] & 1) != 0;
    constexpr Counts all{255, 255, 255};
    const auto readWith = [&](const Counts& most) {
        return read(payload.subspan(4), little, address, groupPort_, most);
    };
    const Said said = readWith(all);
    if (!said.isOfGroup || (!isRelayed_ && said.participant != sender)) return Refusal::Places;
    auto* const known = known_.find(said.participant);
    if (known == nullptr) {
        known_.placeFor(said.participant) = {said.participant, now, {said.places, address}};
        return Refusal::None;
    }
    First& first = known->value;
    if (now - known->met > leaseOfParticipant) first = {said.places, address};
    const Said same = readWith(first.places.counts);
    const bool isItsOwn = isRelayed_ || same.hasSender || address == first.address;
    if (same.places != first.places || !isItsOwn) return Refusal::Places;
    known->met = now;
    return Refusal::None;
}

}  // namespace cortex::comms::rtps
