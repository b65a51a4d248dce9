// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rtps/bytes.hpp"
#include "rtps/refusal.hpp"

#include <cstddef>
#include <cstdint>

namespace cortex::comms::rtps {

inline constexpr std::size_t headerSize = 20;  // of a message
inline constexpr std::size_t senderAt = 8;     // the prefix of the sender, in a message

// The submessages of RTPS 2.3 (9.4.5.1.1) and of DDS-Security 1.1 (7.3.6) that a receiver judges.
enum class Kind : std::uint8_t {
    Pad = 0x01,
    AckNack = 0x06,
    Heartbeat = 0x07,
    Gap = 0x08,
    InfoTimestamp = 0x09,
    InfoSource = 0x0c,
    InfoDestination = 0x0e,
    NackFragments = 0x12,
    HeartbeatFragments = 0x13,
    Data = 0x15,
    DataFragments = 0x16,
    SecureBody = 0x30,
    SecurePrefix = 0x31,
    SecurePostfix = 0x32,
    SignedPrefix = 0x33,
    SignedPostfix = 0x34,
    FirstOfVendors = 0x80,
};

// The built-in writers that announce endpoints (RTPS 2.3, 8.5.4.2), unless they are encrypted.
inline constexpr std::uint32_t announcesParticipants = 0x000100c2, announcesWriters = 0x000003c2,
                               announcesReaders = 0x000004c2;

inline bool isOfSecurity(Kind kind) {
    return kind >= Kind::SecureBody && kind <= Kind::SignedPostfix;
}

struct Submessage {
    Kind kind;
    std::uint8_t flags;
    Bytes whole;  // with its header
    Bytes body;

    bool little() const { return (flags & 1) != 0; }
};

// The submessage that begins at `rest`; `refusal` says whether it ends within it. Of one that is
// not the last, the length is a multiple of 4.
struct Cut {
    Submessage submessage;
    Refusal refusal;
};
Cut cutSubmessage(Bytes rest);

// Whether it begins as a message of RTPS 2.
bool hasHeader(Bytes message);

// Whether it has at least the size of its kind.
bool isLongEnough(const Submessage& submessage);

// Whether the content of a submessage of its kind is within its bounds: minimal sizes, counts and
// sets, numbers that begin with 1. It judges each submessage alone. Content of other kinds is not
// looked at, as Fast DDS skips it.
Refusal judgeContent(const Submessage& submessage);

// The in-line parameters and the payload of a DATA whose content was judged. Each may be empty.
struct DataParts {
    Bytes parameters, payload;
};
DataParts partsOf(const Submessage& data);

// Makes a DATA that says something into a GAP of its number, so its reader has all of the writer
// and knows nothing of this sample. Returns what stands behind it now.
Bytes becomeGap(const Submessage& data);

// The order of signed and encrypted parts: a signed message begins and ends with its prefix and
// postfix; an encrypted submessage stands between its own. It is told each submessage in order.
class SecureOrder {
public:
    bool admits(const Submessage& submessage);
    bool isSigned() const { return isSigned_; }
    // Whether a part that has begun has not ended.
    bool isOpen() const { return state_ != State::Plain || (isSigned_ && !isOver_); }

private:
    enum class State { Plain, Begun, Ending };
    State state_ = State::Plain;
    bool isFirst_ = true, isSigned_ = false, isOver_ = false;
};

}  // namespace cortex::comms::rtps
