// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <span>
#include <utility>

#include <fastdds/rtps/common/GuidPrefix_t.hpp>
#include <fastdds/rtps/common/Locator.h>

namespace cortex::comms {

// What Fast DDS 2.9 sends again though it is known there; among n who join together that is n^3.
// Everybody who finds a newcomer announces himself twice to all whom he knows: here the same goes
// to an address twice, and then once in an interval. And while one lacks an endpoint, all are asked
// each second whether they have them: here not who has said so since. A newcomer gets all. Any
// thread.
class Repeats {
public:
    using Clock = std::chrono::steady_clock;
    using Prefix = eprosima::fastrtps::rtps::GuidPrefix_t;
    using Locator = eprosima::fastrtps::rtps::Locator_t;
    using Datagram = std::span<const std::uint8_t>;

    static constexpr int atOnce = 2;

    // `interval`: between the announcements of a participant that has nothing new to say.
    Repeats(const Prefix& ours, Clock::duration interval) : ours_{ours}, interval_{interval} {}

    // Whether it is of a kind that is repeated.
    static bool concerns(Datagram sent);
    // Of one that is. `socket` tells ways to the same address apart.
    bool needless(Datagram sent, const void* socket, const Locator& to, Clock::time_point now);
    void heard(Datagram received);
    void newcomer(const Prefix& who, const Locator& at);
    void gone(const Prefix& who);

private:
    struct Announced {
        std::size_t content;
        Clock::time_point paidUntil;
    };
    struct Has {  // the number after the last that he has said he has
        std::int64_t publications = 0, subscriptions = 0;
    };

    bool announcedEnough(Datagram submessage, const void* socket, const Locator& to,
                         Clock::time_point now);

    const Prefix ours_;
    const Clock::duration interval_;
    std::mutex mutex_;
    std::map<std::pair<Locator, const void*>, Announced> announced_;
    std::map<Locator, Prefix> livesAt_;
    std::map<Prefix, Has> has_;
};

}  // namespace cortex::comms
