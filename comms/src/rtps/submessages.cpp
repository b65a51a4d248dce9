// SPDX-License-Identifier: Apache-2.0
#include "rtps/submessages.hpp"

#include "rtps/parameters.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace cortex::comms::rtps {
namespace {

constexpr std::size_t submessageHeader = 4;
constexpr std::uint32_t mostBits = 256;             // of a set, by RTPS 2.3, 9.4.2.6
constexpr std::uint32_t largestSample = 16u << 20;  // bytes, of one that is sent in fragments
constexpr std::uint32_t mostFragments = 1u << 16;

struct Minimum {
    Kind kind;
    std::size_t size;
};
constexpr std::array minima{
    Minimum{Kind::AckNack, 24},
    Minimum{Kind::Heartbeat, 28},
    Minimum{Kind::Gap, 28},
    Minimum{Kind::InfoSource, 20},
    Minimum{Kind::InfoDestination, 12},
    Minimum{Kind::NackFragments, 28},
    Minimum{Kind::Data, 20},
    Minimum{Kind::DataFragments, 32},
    Minimum{Kind::SecureBody, 4},
    Minimum{Kind::SecurePrefix, 20},
    Minimum{Kind::SecurePostfix, 20},
    Minimum{Kind::SignedPrefix, 20},
    Minimum{Kind::SignedPostfix, 20},
    Minimum{Kind::HeartbeatFragments, 24},
};

std::size_t minimumOf(Kind kind) {
    for (const Minimum& minimum : minima) {
        if (minimum.kind == kind) return minimum.size;
    }
    return 0;
}

// A set after a base: the number of bits, then the bits in words of 32, then `behind` bytes.
bool setFits(const Submessage& submessage, std::size_t at, std::size_t behind) {
    const std::uint32_t bits = readU32(submessage.body.subspan(at), submessage.little());
    return bits <= mostBits && at + 4 + (bits + 31) / 32 * 4 + behind <= submessage.body.size();
}

Refusal contentUnless(bool good) { return good ? Refusal::None : Refusal::Content; }

Refusal judgeHeartbeat(const Submessage& submessage) {
    const std::int64_t first = readNumber(submessage.body.subspan(8), submessage.little());
    const std::int64_t last = readNumber(submessage.body.subspan(16), submessage.little());
    return contentUnless(first > 0 && last >= first - 1);
}

Refusal judgeGap(const Submessage& submessage) {
    const std::int64_t start = readNumber(submessage.body.subspan(8), submessage.little());
    const std::int64_t base = readNumber(submessage.body.subspan(16), submessage.little());
    return contentUnless(start > 0 && base >= start && setFits(submessage, 24, 0));
}

// Where the in-line parameters of DATA or DATA_FRAG begin, 0 if that is out of bounds.
std::size_t inlineQosAt(const Submessage& submessage, std::size_t least) {
    const std::size_t at = 4 + readU16(submessage.body.subspan(2), submessage.little());
    return at >= least && at % 4 == 0 && at <= submessage.body.size() ? at : 0;
}

// What stands behind the in-line parameters; without data(): they are out of bounds.
Bytes payloadOf(const Submessage& submessage, std::size_t at, Parameters in) {
    Bytes rest = submessage.body.subspan(at);
    if ((submessage.flags & 2) == 0) return rest;
    const std::size_t size = parametersSize(rest, submessage.little(), in);
    return size != 0 ? rest.subspan(size) : Bytes{};
}

constexpr std::uint32_t handshakeWriter = 0x000201c3;

bool isOfDiscovery(std::uint32_t writer) {  // those that send lists of parameters
    constexpr std::array discovery{0x000100c2u, 0x000002c2u, 0x000003c2u, 0x000004c2u,
                                   0xff0003c2u, 0xff0004c2u, 0xff0101c2u};
    for (const std::uint32_t known : discovery) {
        if (known == writer) return true;
    }
    return false;
}

Refusal judgeData(const Submessage& submessage) {
    const bool hasData = (submessage.flags & 4) != 0, hasKey = (submessage.flags & 8) != 0;
    const std::size_t at = inlineQosAt(submessage, 20);
    const std::int64_t number = readNumber(submessage.body.subspan(12), submessage.little());
    if (at == 0 || number <= 0 || (hasData && hasKey)) return Refusal::Content;
    const Bytes payload = payloadOf(submessage, at, Parameters::Inline);
    if (payload.data() == nullptr) return Refusal::Parameters;
    if (!hasData && !hasKey) return Refusal::None;
    if (payload.size() < 4) return Refusal::Content;
    const std::uint32_t writer = readU32(submessage.body.subspan(8), false);
    if (!hasData || (!isOfDiscovery(writer) && writer != handshakeWriter)) return Refusal::None;
    // Encapsulation: plain or a list of parameters, each in one of two byte orders.
    const std::uint8_t plain = writer == handshakeWriter ? 0 : 2;
    if (payload[0] != 0 || (payload[1] & ~1) != plain) return Refusal::Content;
    const bool little = (payload[1] & 1) != 0;
    const Bytes content = payload.subspan(4);
    const bool fits = writer == handshakeWriter
                          ? handshakeFits(content, little)
                          : parametersSize(content, little, Parameters::Discovery) != 0;
    return fits ? Refusal::None : Refusal::Parameters;
}

Refusal judgeDataFragments(const Submessage& submessage) {
    const bool little = submessage.little();
    const Bytes body = submessage.body;
    const std::size_t at = inlineQosAt(submessage, 32);
    const std::uint64_t first = readU32(body.subspan(20), little);
    const std::uint64_t count = readU16(body.subspan(24), little);
    const std::uint64_t size = readU16(body.subspan(26), little);
    const std::uint64_t sample = readU32(body.subspan(28), little);
    if (at == 0 || readNumber(body.subspan(12), little) <= 0 || first == 0 || count == 0 ||
        size == 0)
        return Refusal::Content;
    if (sample > largestSample || isOfDiscovery(readU32(body.subspan(8), false)))
        return Refusal::Fragment;
    if ((sample + size - 1) / size > mostFragments) return Refusal::Fragment;
    const std::uint64_t begin = (first - 1) * size;
    if (begin >= sample || (first + count - 2) * size >= sample) return Refusal::Content;
    const Bytes payload = payloadOf(submessage, at, Parameters::InlineOfFragment);
    if (payload.data() == nullptr) return Refusal::Parameters;
    return contentUnless(payload.size() >= std::min(count * size, sample - begin));
}

Refusal judgeSecureBody(const Submessage& submessage) {
    return contentUnless(readU32(submessage.body, false) <= submessage.body.size() - 4);
}

// A code of 16 bytes, then the number of codes for single receivers, 20 bytes each.
Refusal judgePostfix(const Submessage& submessage) {
    const std::uint64_t receivers = readU32(submessage.body.subspan(16), false);
    return contentUnless(receivers * 20 <= submessage.body.size() - 20);
}

}  // namespace

bool hasHeader(Bytes message) {
    constexpr std::array<std::uint8_t, 4> name{'R', 'T', 'P', 'S'};
    constexpr std::uint8_t major = 2;
    return message.size() >= headerSize &&
           std::memcmp(message.data(), name.data(), name.size()) == 0 && message[4] == major;
}

Cut cutSubmessage(Bytes rest) {
    if (rest.size() < submessageHeader) return {{}, Refusal::Framing};
    const auto kind = static_cast<Kind>(rest[0]);
    const std::size_t stated = readU16(rest.subspan(2), (rest[1] & 1) != 0);
    const bool toTheEnd = stated == 0 && kind != Kind::Pad && kind != Kind::InfoTimestamp;
    const std::size_t size = toTheEnd ? rest.size() : submessageHeader + stated;
    const Cut cut{{kind, rest[1], rest.first(std::min(size, rest.size())), {}}, Refusal::Framing};
    if (size > rest.size() || (size % 4 != 0 && size != rest.size())) return cut;
    return {{kind, rest[1], cut.submessage.whole, cut.submessage.whole.subspan(submessageHeader)},
            Refusal::None};
}

DataParts partsOf(const Submessage& data) {
    const Bytes rest = data.body.subspan(inlineQosAt(data, 20));
    if ((data.flags & 2) == 0) return {{}, rest};
    const std::size_t size = parametersSize(rest, data.little(), Parameters::Inline);
    return {rest.first(size), rest.subspan(size)};
}

Bytes becomeGap(const Submessage& data) {
    constexpr std::size_t header = 4, size = 28;
    const bool little = data.little();
    const std::int64_t number = readNumber(data.body.subspan(12), little);
    const Bytes body = data.whole.subspan(header, size);
    std::ranges::copy(data.body.subspan(4, 8), body.begin());  // reader and writer
    writeNumber(body.subspan(8), little, number);
    writeNumber(body.subspan(16), little, number + 1);
    writeU32(body.subspan(24), little, 0);
    data.whole[0] = static_cast<std::uint8_t>(Kind::Gap);
    data.whole[1] = little ? 1 : 0;
    data.whole[2] = little ? size : 0;
    data.whole[3] = little ? 0 : size;
    return data.whole.subspan(header + size);
}

bool isLongEnough(const Submessage& submessage) {
    return submessage.body.size() >= minimumOf(submessage.kind);
}

Refusal judgeContent(const Submessage& submessage) {
    if (!isLongEnough(submessage)) return Refusal::Content;
    switch (submessage.kind) {
        case Kind::AckNack:
            return contentUnless(readNumber(submessage.body.subspan(8), submessage.little()) >= 0 &&
                                 setFits(submessage, 16, 4));
        case Kind::Heartbeat:
            return judgeHeartbeat(submessage);
        case Kind::Gap:
            return judgeGap(submessage);
        case Kind::InfoTimestamp:
            return contentUnless((submessage.flags & 2) != 0 || submessage.body.size() >= 8);
        case Kind::NackFragments:
            return contentUnless(readNumber(submessage.body.subspan(8), submessage.little()) > 0 &&
                                 readU32(submessage.body.subspan(16), submessage.little()) > 0 &&
                                 setFits(submessage, 20, 4));
        case Kind::Data:
            return judgeData(submessage);
        case Kind::DataFragments:
            return judgeDataFragments(submessage);
        case Kind::SecureBody:
            return judgeSecureBody(submessage);
        case Kind::SecurePostfix:
        case Kind::SignedPostfix:
            return judgePostfix(submessage);
        default:
            return Refusal::None;
    }
}

bool SecureOrder::admits(const Submessage& submessage) {
    const bool isFirst = std::exchange(isFirst_, false);
    if (isOver_) return false;
    switch (state_) {
        case State::Begun:
            state_ = State::Ending;
            return true;
        case State::Ending:
            state_ = State::Plain;
            return submessage.kind == Kind::SecurePostfix;
        case State::Plain:
            break;
    }
    switch (submessage.kind) {
        case Kind::SignedPrefix:
            return isSigned_ = isFirst;
        case Kind::SignedPostfix:
            return isOver_ = isSigned_;
        case Kind::SecurePrefix:
            state_ = State::Begun;
            return true;
        case Kind::SecureBody:
            return isSigned_;  // of a message that is encrypted as a whole
        default:
            return submessage.kind != Kind::SecurePostfix;
    }
}

}  // namespace cortex::comms::rtps
