// SPDX-License-Identifier: Apache-2.0
#include "rtps/pieces.hpp"

#include "rtps/submessages.hpp"

#include <algorithm>

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

// What Fast DDS sends of its statistics at the end. Its transport writes them into the last 60
// bytes of whatever it sends, if they begin as these do; so each piece ends with them.
Bytes statisticsIn(Bytes datagram) {
    for (std::size_t at = headerSize; at < datagram.size();) {
        const auto [submessage, refusal] = cutSubmessage(datagram.subspan(at));
        if (refusal != Refusal::None) return {};
        at += submessage.whole.size();
        if (submessage.kind >= Kind::FirstOfVendors && at == datagram.size())
            return submessage.whole;
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

void put(std::vector<std::uint8_t>& to, std::uint32_t value, std::size_t bytes) {
    for (std::size_t i = 0; i < bytes; ++i) to.push_back(static_cast<std::uint8_t>(value >> 8 * i));
}

// The DATA at the end of a part, if it is a sample of a writer that is to be cut.
Bytes toCut(Bytes part, std::uint32_t writer) {
    for (std::size_t at = 0; at < part.size() && part.size() > onePacket;) {
        const Submessage submessage = cutSubmessage(part.subspan(at)).submessage;
        const Bytes body = submessage.body;
        const bool hasData = submessage.little() && (submessage.flags & 4) != 0;
        if (submessage.kind == Kind::Data && hasData && readU32(body.subspan(8), false) == writer)
            return submessage.whole;
        at += submessage.whole.size();
    }
    return {};
}

// The fragments that a sample becomes, each behind `front`: RTPS 2.3, 9.4.5.4.
void appendFragments(std::vector<std::vector<std::uint8_t>>& pieces, Bytes front, Bytes data) {
    constexpr std::size_t fragment = 1'200;
    const Submessage submessage = cutSubmessage(data).submessage;
    const auto [parameters, payload] = partsOf(submessage);
    std::uint32_t number = 0;
    for (Bytes rest = payload; !rest.empty();) {
        const Bytes content = rest.first(std::min(fragment, rest.size()));
        std::vector<std::uint8_t>& piece = pieces.emplace_back(front.begin(), front.end());
        piece.push_back(static_cast<std::uint8_t>(Kind::DataFragments));
        piece.push_back(submessage.flags & 3);  // the byte order, and whether parameters are there
        put(piece, static_cast<std::uint32_t>(32 + parameters.size() + content.size()), 2);
        put(piece, 0, 2);
        put(piece, 28, 2);                              // from here to the parameters
        append(piece, submessage.body.subspan(4, 16));  // reader, writer, number
        put(piece, ++number, 4);
        put(piece, 1, 2);
        put(piece, fragment, 2);
        put(piece, static_cast<std::uint32_t>(payload.size()), 4);
        append(piece, parameters);
        append(piece, content);
        rest = rest.subspan(content.size());
    }
}

}  // namespace

std::vector<std::vector<std::uint8_t>> piecesOf(Bytes datagram, std::uint32_t cut) {
    std::vector<std::vector<std::uint8_t>> pieces;
    if (datagram.size() <= onePacket || !hasHeader(datagram)) return pieces;
    const Bytes statistics = statisticsIn(datagram);
    datagram = datagram.first(datagram.size() - statistics.size());
    const std::size_t room = onePacket - std::min(onePacket, statistics.size());
    Context context;
    for (Bytes rest = datagram.subspan(headerSize); !rest.empty();) {
        const Bytes part = firstPart(rest);
        if (part.empty()) return {};
        const Context before = context;
        context.take(part);
        const Bytes sample = cut != 0 ? toCut(part, cut) : Bytes{};
        if (sample.empty() && part.size() == datagram.size() - headerSize) return {};
        rest = rest.subspan(part.size());
        if (!sample.empty()) {
            std::vector<std::uint8_t> front{datagram.begin(), datagram.begin() + headerSize};
            append(front, context.destination);
            append(front, context.time);
            appendFragments(pieces, front, sample);
            continue;
        }
        if (pieces.empty() || pieces.back().size() + part.size() > room) {
            append(pieces.emplace_back(), datagram.first(headerSize));
            append(pieces.back(), before.destination);
            append(pieces.back(), before.time);
        }
        append(pieces.back(), part);
    }
    for (std::vector<std::uint8_t>& piece : pieces) append(piece, statistics);
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
