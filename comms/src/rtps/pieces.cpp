// SPDX-License-Identifier: Apache-2.0
#include "rtps/pieces.hpp"

#include "rtps/submessages.hpp"

namespace cortex::comms::rtps {
namespace {

// A gap counts with what its writer sends behind it, see DatagramFilter.
bool goesWithNext(Kind kind) {
    return kind == Kind::InfoTimestamp || kind == Kind::InfoDestination || kind == Kind::Gap;
}

// The first submessages that have to stay together; empty if they cannot be told.
Bytes firstPart(Bytes rest) {
    for (std::size_t size = 0; size < rest.size();) {
        const auto [submessage, refusal] = cutSubmessage(rest.subspan(size));
        if (refusal != Refusal::None || isOfSecurity(submessage.kind) ||
            submessage.kind == Kind::InfoSource)
            return {};
        size += submessage.whole.size();
        if (!goesWithNext(submessage.kind) || size == rest.size()) return rest.first(size);
    }
    return {};
}

// What of a part holds for those behind it, too.
struct Context {
    Bytes destination, time;

    void take(Bytes part) {
        for (std::size_t at = 0; at < part.size();) {
            const Submessage submessage = cutSubmessage(part.subspan(at)).submessage;
            if (submessage.kind == Kind::InfoDestination) destination = submessage.whole;
            if (submessage.kind == Kind::InfoTimestamp) time = submessage.whole;
            at += submessage.whole.size();
        }
    }
};

void append(std::vector<std::uint8_t>& to, Bytes bytes) {
    to.insert(to.end(), bytes.begin(), bytes.end());
}

}  // namespace

std::vector<std::vector<std::uint8_t>> piecesOf(Bytes datagram) {
    std::vector<std::vector<std::uint8_t>> pieces;
    if (datagram.size() <= onePacket || !hasHeader(datagram)) return pieces;
    Context context;
    for (Bytes rest = datagram.subspan(headerSize); !rest.empty();) {
        const Bytes part = firstPart(rest);
        if (part.empty()) return {};
        if (part.size() == datagram.size() - headerSize) return {};
        if (pieces.empty() || pieces.back().size() + part.size() > onePacket) {
            append(pieces.emplace_back(), datagram.first(headerSize));
            append(pieces.back(), context.destination);
            append(pieces.back(), context.time);
        }
        append(pieces.back(), part);
        context.take(part);
        rest = rest.subspan(part.size());
    }
    return pieces;
}

bool isAboutEndpoints(Bytes datagram) {
    if (!hasHeader(datagram)) return false;
    for (std::size_t at = headerSize; at < datagram.size();) {
        const auto [submessage, refusal] = cutSubmessage(datagram.subspan(at));
        if (refusal != Refusal::None || !isLongEnough(submessage)) return false;
        const bool isData = submessage.kind == Kind::Data;
        if (isData || submessage.kind == Kind::Heartbeat || submessage.kind == Kind::AckNack) {
            const std::uint32_t writer = readU32(submessage.body.subspan(isData ? 8 : 4), false);
            if (writer == announcesWriters || writer == announcesReaders) return true;
        }
        at += submessage.whole.size();
    }
    return false;
}

}  // namespace cortex::comms::rtps
