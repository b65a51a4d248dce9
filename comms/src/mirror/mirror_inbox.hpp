// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mirror/mirror_view.hpp"
#include "wire/messages.hpp"

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <variant>
#include <vector>

namespace cortex::comms {

// The presence of this agent was withdrawn.
struct Withdrawn {
    Id agent;
};

// A block does not say on which stream it came.
struct StreamBlock {
    Block block;
    std::size_t stream;
};

using MirrorSample = std::variant<Presence, Model, StreamBlock, Summary, Answer, EventMessage,
                                  PastMessage, Withdrawn>;

// Carries samples from the threads of DDS to the mirror's thread. It is bounded. Any thread.
class MirrorInbox {
public:
    void push(MirrorSample sample);
    void wake();  // take() returns
    // Takes what has come, in order. Waits for something until `limit`.
    std::vector<MirrorSample> take(Moment limit);
    std::uint64_t dropped() const;  // for lack of room

private:
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<MirrorSample> samples_;
    std::size_t blocks_ = 0;
    bool woken_ = false;
    std::uint64_t dropped_ = 0;
};

}  // namespace cortex::comms
