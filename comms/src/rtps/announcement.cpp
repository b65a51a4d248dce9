// SPDX-License-Identifier: Apache-2.0
#include "rtps/announcement.hpp"

#include "rtps/parameters.hpp"

#include <algorithm>
#include <string_view>

namespace cortex::comms::rtps {
namespace {

constexpr std::uint16_t topicName = 0x0005, domainId = 0x000f, endpointGuid = 0x005a,
                        keyHash = 0x0070, statusInfo = 0x0071;

WriterGuid guidIn(Bytes bytes) {
    WriterGuid guid{};
    if (bytes.size() == guid.size()) std::ranges::copy(bytes, guid.begin());
    return guid;
}

// The size of a text and its end stand around it.
bool isOfCortex(Bytes topic) {
    constexpr std::string_view front = "cortex/";
    return topic.size() > 4 + front.size() &&
           std::ranges::equal(topic.subspan(4, front.size()), front);
}

// Fast DDS takes the hash of the key for the name of the endpoint if it stands behind it.
Announcement alive(Bytes payload) {
    const bool little = (payload[1] & 1) != 0;
    const WriterGuid guid = guidIn(parameterOf(payload.subspan(4), little, endpointGuid));
    const WriterGuid hash = guidIn(parameterOf(payload.subspan(4), little, keyHash));
    if (guid == WriterGuid{} || (hash != WriterGuid{} && hash != guid))
        return {Announcement::Unclear, {}};
    const bool ours = isOfCortex(parameterOf(payload.subspan(4), little, topicName));
    return {ours ? Announcement::IsThere : Announcement::IsForeign, guid};
}

}  // namespace

Announcement announcementIn(const Submessage& data) {
    const std::uint32_t writer = readU32(data.body.subspan(8), false);
    if (writer != announcesWriters && writer != announcesReaders) return {};
    const auto [parameters, payload] = partsOf(data);
    const Bytes status = parameterOf(parameters, data.little(), statusInfo);
    if (status.size() == 4 && (status[3] & 3) != 0)  // disposed of, unregistered
        return {Announcement::IsGone, guidIn(parameterOf(parameters, data.little(), keyHash))};
    const bool hasData = (data.flags & 4) != 0;
    return hasData ? alive(payload) : Announcement{Announcement::Unclear, {}};
}

std::int64_t domainIn(const Submessage& data) {
    const bool hasData = (data.flags & 4) != 0;
    if (!hasData || readU32(data.body.subspan(8), false) != announcesParticipants) return -1;
    const Bytes payload = partsOf(data).payload;
    const bool little = (payload[1] & 1) != 0;
    const Bytes named = parameterOf(payload.subspan(4), little, domainId);
    return named.size() == 4 ? std::int64_t{readU32(named, little)} : -1;
}

}  // namespace cortex::comms::rtps
