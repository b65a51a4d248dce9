// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"
#include "cortex/core/event_memory.hpp"

#include "comms/inbox.hpp"

#include <cstdint>
#include <string>

namespace cortex::comms {

// What an agent keeps of the past, as soon as it has answered or cannot answer.
inline PastEvents pastOf(Mirror& mirror, const std::string& agent, std::int64_t from = 0,
                         std::int64_t until = EventMemory::always,
                         const test::Place& place = test::Place::current()) {
    const std::uint64_t ask = mirror.askPast(agent, from, until);
    PastEvents past;
    EXPECT_TRUE(comesTrue([&] { return mirror.pollPast(ask, past); }, place));
    return past;
}

}  // namespace cortex::comms
