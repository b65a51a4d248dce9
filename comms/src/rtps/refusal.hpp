// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace cortex::comms::rtps {

// Why a datagram was dropped before Fast DDS saw it.
enum class Refusal : std::uint8_t {
    None,
    Framing,       // not RTPS, or submessages that do not add up to the datagram
    Content,       // a submessage that is too short, or whose counts and sets are out of bounds
    Parameters,    // a list of parameters without an end, or with counts beyond it
    Number,        // a sequence number that its writer cannot have reached
    Fragment,      // a fragment where none is needed, or of a sample that is too large
    Participants,  // more participants than an address or the network may have
    Unfinished,    // fragments of a sample that was never complete, while others needed the room
    Incomplete,    // fragments of a sample of which others never came
    Endpoints,  // an announcement of one endpoint more than a participant or the network may have
    Echo,       // what this participant itself has sent to a group of which it is
    Domain,     // a participant that says that it is of another domain
    Places,     // a participant that says other addresses than at first, or that another announces
    Early,      // of one that was silent for a lease, a moment after it came back
};
inline constexpr std::size_t refusals = 14;

// What belongs to a network that works is not.
constexpr bool isCounted(Refusal refusal) {
    return refusal != Refusal::Echo && refusal != Refusal::Early;
}

// What an event says of it, behind "N datagrams were dropped: ".
constexpr const char* wordsOf(Refusal refusal) {
    constexpr const char* words[refusals] = {
        "",
        "they are no messages of RTPS",
        "a submessage is out of bounds",
        "a list of parameters is out of bounds",
        "their sequence numbers do not follow those of their writer, as after a loss",
        "they are fragments of what is never sent in fragments, or of too much",
        "there are too many participants",
        "they began more samples in fragments than there is room for",
        "other fragments of their sample never came",
        "they announce more endpoints than there is room for",
        "they are its own",
        "they announce participants of another domain, which uses our ports",
        "they announce a participant with other addresses than at first, as a forger does",
        "their sender came back just now",
    };
    return words[static_cast<std::size_t>(refusal)];
}

}  // namespace cortex::comms::rtps
