// SPDX-License-Identifier: Apache-2.0
#include "rtps/pieces.hpp"

#include "rtps/submessages.hpp"

#include <algorithm>
#include <utility>

namespace cortex::comms::rtps {
namespace {

constexpr std::size_t statisticsSize = 60;                // with their header
constexpr std::size_t room = onePacket - statisticsSize;  // of a piece, in front of them

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

// The statistics of Fast DDS at the end of a datagram. Bytes of a sample may look like them.
Bytes statisticsIn(Bytes datagram) {
    for (std::size_t at = headerSize; at < datagram.size();) {
        const auto [submessage, refusal] = cutSubmessage(datagram.subspan(at));
        if (refusal != Refusal::None) return {};
        at += submessage.whole.size();
        if (at == datagram.size() && submessage.kind == Kind::FirstOfVendors &&
            submessage.whole.size() == statisticsSize)
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
    for (std::size_t at = 0; at < part.size();) {
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
void appendFragments(std::vector<std::vector<std::uint8_t>>& pieces,
                     const std::vector<std::uint8_t>& front, Bytes data) {
    constexpr std::size_t fragment = 1'200;
    constexpr std::size_t destination = 16, time = 12, before = 36, key = 24;
    static_assert(headerSize + destination + time + before + key + fragment <= room);
    const Submessage submessage = cutSubmessage(data).submessage;
    const auto [parameters, payload] = partsOf(submessage);
    std::uint32_t number = 0;
    for (Bytes rest = payload; !rest.empty();) {
        const Bytes content = rest.first(std::min(fragment, rest.size()));
        std::vector<std::uint8_t>& piece = pieces.emplace_back(front);
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
    Context context;
    const auto front = [&] {
        std::vector<std::uint8_t> bytes{datagram.begin(), datagram.begin() + headerSize};
        append(bytes, context.destination);
        append(bytes, context.time);
        return bytes;
    };
    for (Bytes rest = datagram.subspan(headerSize); !rest.empty();) {
        const Bytes part = firstPart(rest);
        if (part.empty()) return {};
        std::vector<std::uint8_t> piece = front();
        context.take(part);
        const bool isLong = piece.size() + part.size() > room;
        const Bytes sample = isLong && cut != 0 ? toCut(part, cut) : Bytes{};
        if (sample.empty() && part.size() == datagram.size() - headerSize) return {};
        rest = rest.subspan(part.size());
        if (!sample.empty()) {
            appendFragments(pieces, front(), sample);
            continue;
        }
        if (pieces.empty() || pieces.back().size() + part.size() > room)
            pieces.push_back(std::move(piece));
        append(pieces.back(), part);
    }
    for (std::vector<std::uint8_t>& piece : pieces) append(piece, statistics);
    return pieces;
}

void endWithStatistics(std::vector<std::uint8_t>& piece) {
    constexpr auto kind = static_cast<std::uint8_t>(Kind::FirstOfVendors);
    constexpr std::uint8_t bodySize = statisticsSize - 4;
    if (piece.size() < headerSize + statisticsSize) return;
    if (piece[piece.size() - statisticsSize] != kind || !statisticsIn(piece).empty()) return;
    piece.insert(piece.end(), {kind, 1, bodySize, 0});  // 1: little endian
    piece.resize(piece.size() + bodySize);
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
