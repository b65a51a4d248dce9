// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rtps/writer_numbers.hpp"

#include <cstddef>
#include <cstdint>
#include <list>
#include <vector>

namespace cortex::comms::rtps {

using Message = std::vector<std::uint8_t>;

// What a DATA_FRAG says of itself; its framing and content are judged already.
struct Fragment {
    WriterGuid writer;
    std::int64_t number;         // of the sample
    std::uint32_t first, count;  // fragments, from 1
    std::uint32_t size, sample;  // bytes of each but the last, and of all
    bool comesAgain;             // whether the writer sends again what was lost
};

// Keeps fragments until a sample has all of them. Fast DDS takes the memory of a whole sample when
// it gets the first fragment; here one costs what has arrived of it. When there is no room, the
// sample is dropped that has got nothing for the longest time: of the same writer if it has begun
// others, else of any. One thread at a time.
class Fragments {
public:
    static constexpr std::size_t mostOfWriter = 64, most = 512;  // samples that have begun
    static constexpr std::size_t mostBytes = 17u << 20;          // of all that is kept
    static constexpr std::int64_t patience = 10'000'000'000;     // ns, then one is forgotten

    // All messages of the sample that `message` completes, in the order of their arrival; empty
    // while some are missing.
    std::vector<Message> add(const Fragment& fragment, Message message, std::int64_t now);

    std::size_t bytes() const { return bytes_; }
    std::uint64_t dropped() const { return dropped_; }        // messages, for want of room
    std::uint64_t incomplete() const { return incomplete_; }  // and as others never came

private:
    struct Begun {
        Fragment of;
        std::int64_t met = 0;
        std::uint32_t missing = 0;
        std::vector<bool> has;
        std::vector<Message> messages;
        std::size_t bytes = 0;
    };
    using Place = std::list<Begun>::iterator;

    Place placeOf(const Fragment& fragment);
    void makeRoom(const WriterGuid& writer);
    void drop(Place place, std::uint64_t& count);
    void forget(Place place);

    std::list<Begun> begun_;  // the last one got something last
    std::size_t bytes_ = 0;
    std::uint64_t dropped_ = 0, incomplete_ = 0;
};

}  // namespace cortex::comms::rtps
