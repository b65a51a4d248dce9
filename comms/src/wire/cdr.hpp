// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "wire/messages.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

// The encoding of the messages that are topics: Presence, Model, Interest, Block, Summary, Command,
// Answer and EventMessage. It is plain CDR, the Common Data Representation of the OMG
// (DDS-XTypes 1.3, 7.4.1, calls it XCDR version 1). Written little endian, read in both orders.
// Free of state: any thread. Fast CDR 1.0 comes with Fast DDS and is not used: it reserves as much
// memory as a sample says and throws where one ends early. This decoder bounds each count by the
// octets that are left.
namespace cortex::comms {

inline constexpr std::size_t maxTextLength = 64 * 1024;  // octets of a string
// Octets of a message that is neither Block nor Model: it has to fit into one datagram.
inline constexpr std::size_t maxInOneDatagram = 64'000;

template <class Message>
std::size_t encodedSize(const Message& message);  // with the 4 octets of encapsulation

// Returns the number of octets written. 0: the payload is too small, or a string is too long. A NUL
// ends a string.
template <class Message>
std::size_t encode(const Message& message, std::span<std::uint8_t> payload);
template <class Message>
bool canEncode(const Message& message);  // false: a string is too long

// False: the payload is malformed; `message` then has some valid value. True: every field was read,
// and at most 3 octets of padding follow. The memory that it reserves is in proportion to the
// payload, whatever the payload claims. A message that is used again keeps its memory.
template <class Message>
bool decode(std::span<const std::uint8_t> payload, Message& message);

}  // namespace cortex::comms
