// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rtps/bytes.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cortex::comms::rtps {

// Bytes of a datagram that fits one packet of Ethernet. A longer one is lost with any of its
// packets.
inline constexpr std::size_t onePacket = 1400;

// The datagrams, of one packet each as far as their submessages allow it, that say what a longer
// one of our own says. Samples of `cut`, the id of a writer, become fragments of one packet; 0:
// of none. Each ends with the statistics of Fast DDS that the whole ends with. Empty: it is to be
// sent as it is, because it is short, has one part beside statistics, or is signed.
std::vector<std::vector<std::uint8_t>> piecesOf(Bytes datagram, std::uint32_t cut = 0);

// Ends a piece with empty statistics if Fast DDS would take its own last 60 bytes for them.
void endWithStatistics(std::vector<std::uint8_t>& piece);

// Whether a datagram of our own speaks of endpoints, unless it is encrypted.
bool isAboutEndpoints(Bytes datagram);

}  // namespace cortex::comms::rtps
