// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rtps/bytes.hpp"

#include <cstddef>
#include <cstdint>

namespace cortex::comms::rtps {

enum class Parameters {
    Inline,            // of one sample
    InlineOfFragment,  // of a fragment
    Discovery,         // what participants and endpoints say of themselves
};

// The size of a list of parameters (RTPS 2.3, 9.4.2.11) with its end, 0 if it has none within
// `list` or a parameter is out of bounds. Two kinds are changed into padding, which readers skip:
// 1. The hash of the key in a fragment. Fast DDS 2.9 keeps such a sample in two lists before it is
//    complete, and forgets one of them if the writer goes.
// 2. Descriptions of types by TypeObject. CorteX needs none, and decoding one may reserve any
//    amount of memory.
std::size_t parametersSize(Bytes list, bool little, Parameters in);

// The content of a parameter of that kind in such a list; of several, the last, as Fast DDS reads
// them. Empty: there is none.
Bytes parameterOf(Bytes list, bool little, std::uint16_t id);

// Whether a message of the handshake of DDS-Security 1.1 (7.4.3.3), which everybody may send, has
// as much as it says: two identities, a destination, a source, a kind, and up to 8 tokens.
bool handshakeFits(Bytes message, bool little);

}  // namespace cortex::comms::rtps
