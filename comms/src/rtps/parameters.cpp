// SPDX-License-Identifier: Apache-2.0
#include "rtps/parameters.hpp"

#include <cstdint>

namespace cortex::comms::rtps {
namespace {

// Identifiers of parameters: RTPS 2.3, 9.6.3; DDS-Security 1.1, 7.4.1; DDS-XTypes 1.3, 7.6.3.
enum Id : std::uint16_t {
    padding = 0x0000,
    sentinel = 0x0001,
    leaseDuration = 0x0002,
    topicName = 0x0005,
    typeName = 0x0007,
    partition = 0x0029,
    userData = 0x002c,
    groupData = 0x002d,
    topicData = 0x002e,
    propertyList = 0x0059,
    entityName = 0x0062,
    typeIdV1 = 0x0069,
    keyHash = 0x0070,
    statusInfo = 0x0071,
    typeObjectV1 = 0x0072,
    dataRepresentation = 0x0073,
    typeInformation = 0x0075,
    identityToken = 0x1001,
    permissionsToken = 0x1002,
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
        case leaseDuration:
            return bytes.size() >= 8 && content.count() <= longestLease;
        case topicName:
        case typeName:
        case entityName:
            content.text(longestName);
            return content.fits();
        case userData:
        case groupData:
        case topicData:
            content.text(longestData);
            return content.fits();
        case partition:
            content.texts(mostProperties, longestName);
            return content.fits();
        case dataRepresentation:
            return bytes.size() >= 4 && readU32(bytes, little) <= (bytes.size() - 4) / 2;
        case propertyList:
            takePairs(content, longestData);
            return content.fits();
        case identityToken:
        case permissionsToken:
            takeToken(content);
            return content.fits();
        default:
            return true;
    }
}

bool inlineFits(std::uint16_t id, Bytes bytes) {
    if (id == keyHash) return bytes.size() == 16;
    return id != statusInfo || bytes.size() == 4;
}

bool isSkipped(std::uint16_t id, Parameters in) {
    if (in == Parameters::InlineOfFragment) return id == keyHash;
    return in == Parameters::Discovery &&
           (id == typeIdV1 || id == typeObjectV1 || id == typeInformation);
}

}  // namespace

std::size_t parametersSize(Bytes list, bool little, Parameters in) {
    for (std::size_t at = 0; at + 4 <= list.size();) {
        const std::uint16_t id = readU16(list.subspan(at), little);
        const std::size_t size = readU16(list.subspan(at + 2), little);
        if (id == sentinel) return at + 4;
        if (size % 4 != 0 || size > list.size() - at - 4) return 0;
        const Bytes content = list.subspan(at + 4, size);
        if (isSkipped(id, in)) {
            list[at] = list[at + 1] = padding;
        } else if (!(in == Parameters::Discovery ? discoveryFits(id, content, little)
                                                 : inlineFits(id, content))) {
            return 0;
        }
        at += 4 + size;
    }
    return 0;
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
