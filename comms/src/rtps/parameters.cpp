// SPDX-License-Identifier: Apache-2.0
#include "rtps/parameters.hpp"

#include <cstdint>

namespace cortex::comms::rtps {
namespace {

// Identifiers of parameters: RTPS 2.3, 9.6.3; DDS-Security 1.1, 7.4.1; DDS-XTypes 1.3, 7.6.3.
enum Id : std::uint16_t {
    Padding = 0x0000,
    Sentinel = 0x0001,
    LeaseDuration = 0x0002,
    TopicName = 0x0005,
    TypeName = 0x0007,
    Partition = 0x0029,
    UserData = 0x002c,
    GroupData = 0x002d,
    TopicData = 0x002e,
    PropertyList = 0x0059,
    EntityName = 0x0062,
    TypeIdV1 = 0x0069,
    KeyHash = 0x0070,
    StatusInfo = 0x0071,
    TypeObjectV1 = 0x0072,
    DataRepresentation = 0x0073,
    TypeInformation = 0x0075,
    IdentityToken = 0x1001,
    PermissionsToken = 0x1002,
};

constexpr std::uint32_t longestName = 256;
constexpr std::uint32_t longestData = 512;  // of a user, group or topic
constexpr std::uint32_t mostProperties = 64;
constexpr std::uint32_t longestLease = 3600;  // s

// Takes what is counted from the front of a parameter; once something is missing, everything is.
class Content {
public:
    Content(Bytes content, bool little) : rest_{content}, little_{little} {}

    std::uint32_t count() {
        if (rest_.size() < 4) fail();
        if (failed_) return 0;
        const std::uint32_t value = readU32(rest_, little_);
        rest_ = rest_.subspan(4);
        return value;
    }

    void text(std::uint32_t longest) {
        const std::size_t size = count();
        const std::size_t padded = (size + 3) / 4 * 4;
        if (size > longest || size > rest_.size()) fail();
        if (!failed_) rest_ = rest_.subspan(std::min(padded, rest_.size()));
    }

    void texts(std::uint32_t most, std::uint32_t each) {
        const std::uint32_t number = count();
        if (number > most) fail();
        for (std::uint32_t i = 0; i < number && !failed_; ++i) text(each);
    }

    void fail() { failed_ = true; }
    bool fits() const { return !failed_; }

private:
    Bytes rest_;
    const bool little_;
    bool failed_ = false;
};

// A number of pairs of texts, or of a text and bytes, which are written alike.
void takePairs(Content& content, std::uint32_t longest) {
    const std::uint32_t pairs = content.count();
    if (pairs > mostProperties) content.fail();
    for (std::uint32_t i = 0; i < 2 * pairs && content.fits(); ++i) content.text(longest);
}

// Of security: a name, then pairs of texts, then pairs of texts and bytes.
void takeToken(Content& content) {
    constexpr std::uint32_t longestValue = 1u << 16;  // a certificate
    content.text(longestName);
    takePairs(content, longestValue);
    takePairs(content, longestValue);
}

bool discoveryFits(std::uint16_t id, Bytes bytes, bool little) {
    Content content{bytes, little};
    switch (id) {
        case LeaseDuration:
            return bytes.size() >= 8 && content.count() <= longestLease;
        case TopicName:
        case TypeName:
        case EntityName:
            content.text(longestName);
            return content.fits();
        case UserData:
        case GroupData:
        case TopicData:
            content.text(longestData);
            return content.fits();
        case Partition:
            content.texts(mostProperties, longestName);
            return content.fits();
        case DataRepresentation:
            return bytes.size() >= 4 && readU32(bytes, little) <= (bytes.size() - 4) / 2;
        case PropertyList:
            takePairs(content, longestData);
            return content.fits();
        case IdentityToken:
        case PermissionsToken:
            takeToken(content);
            return content.fits();
        default:
            return true;
    }
}

bool inlineFits(std::uint16_t id, Bytes bytes) {
    if (id == KeyHash) return bytes.size() == 16;
    return id != StatusInfo || bytes.size() == 4;
}

bool isSkipped(std::uint16_t id, Parameters in) {
    if (in == Parameters::InlineOfFragment) return id == KeyHash;
    return in == Parameters::Discovery &&
           (id == TypeIdV1 || id == TypeObjectV1 || id == TypeInformation);
}

}  // namespace

std::size_t parametersSize(Bytes list, bool little, Parameters in) {
    for (std::size_t at = 0; at + 4 <= list.size();) {
        const std::uint16_t id = readU16(list.subspan(at), little);
        const std::size_t size = readU16(list.subspan(at + 2), little);
        if (id == Sentinel) return at + 4;
        if (size % 4 != 0 || size > list.size() - at - 4) return 0;
        const Bytes content = list.subspan(at + 4, size);
        if (isSkipped(id, in)) {
            list[at] = list[at + 1] = Padding;
        } else if (!(in == Parameters::Discovery ? discoveryFits(id, content, little)
                                                 : inlineFits(id, content))) {
            return 0;
        }
        at += 4 + size;
    }
    return 0;
}

Bytes parameterOf(Bytes list, bool little, std::uint16_t id) {
    Bytes found;
    for (std::size_t at = 0; at + 4 <= list.size();) {
        const std::uint16_t each = readU16(list.subspan(at), little);
        const std::size_t size = readU16(list.subspan(at + 2), little);
        if (each == Sentinel || size > list.size() - at - 4) break;
        if (each == id) found = list.subspan(at + 4, size);
        at += 4 + size;
    }
    return found;
}

bool handshakeFits(Bytes message, bool little) {
    constexpr std::size_t identities = 96;
    constexpr std::uint32_t mostTokens = 8;
    if (message.size() < identities) return false;
    Content content{message.subspan(identities), little};
    content.text(longestName);
    const std::uint32_t tokens = content.count();
    if (tokens > mostTokens) return false;
    for (std::uint32_t i = 0; i < tokens && content.fits(); ++i) takeToken(content);
    return content.fits();
}

}  // namespace cortex::comms::rtps
