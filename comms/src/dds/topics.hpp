// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "wire/ids.hpp"
#include "wire/messages.hpp"

#include <concepts>
#include <string>
#include <string_view>

// The topics of docs/protocol.md.
namespace cortex::comms {

enum class Qos {
    State,     // reliable; a late joiner gets the newest sample of each key
    Cycle,     // best effort; the newest sample wins
    Exchange,  // reliable; keeps 64 samples of each key, and a late joiner gets none
    Log,       // reliable; a writer has one key, and a late joiner gets its newest 1000 samples
    Beacon,    // as State, but written so often that the next sample replaces a lost one
};

struct Topic {
    std::string name;
    Qos qos;
};

namespace topics {
inline const Topic presence{"cortex/presence", Qos::Beacon};
inline const Topic model{"cortex/1/model", Qos::State};
inline const Topic interest{"cortex/1/interest", Qos::State};
inline const Topic view5{"cortex/1/view/5", Qos::Cycle};
inline const Topic view30{"cortex/1/view/30", Qos::Cycle};
inline const Topic view100{"cortex/1/view/100", Qos::Cycle};
inline const Topic viewEvery{"cortex/1/view/every", Qos::Cycle};
inline const Topic summary{"cortex/1/view/summary", Qos::Cycle};
inline const Topic command{"cortex/1/command", Qos::Exchange};
inline const Topic event{"cortex/1/event", Qos::Log};
inline const Topic past{"cortex/1/past", Qos::Exchange};
inline Topic linkOf(const std::string& agent) {
    return {"cortex/1/link/" + toHex(agentId(agent)), Qos::Cycle};
}
// Of the commands of some senders, one of sixteen: the first digit of the sender's id names it.
inline Topic answerTo(const std::string& sender) {
    return {"cortex/1/answer/" + toHex(agentId(sender)).substr(0, 1), Qos::Exchange};
}
}  // namespace topics

// Whether samples of a topic may be so large that they are sent in fragments. All others fit one
// datagram.
inline bool mayBeFragmented(std::string_view topic) {
    return topic == topics::model.name || topic.starts_with("cortex/1/link/") ||
           topic.starts_with("cortex/1/view/");
}

// Whether samples of a message have a key, as those of most topics do.
template <class M>
concept Keyed = requires(const M& message) {
    { message.key() } -> std::same_as<const Id&>;
};

}  // namespace cortex::comms
