// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fastdds/rtps/common/Guid.h>
#include <fastdds/rtps/common/Locator.h>

namespace cortex::comms {

// What Fast DDS 2.9 sends again though it is known there; among n who join together that is n^3.
// Everybody who finds a newcomer announces himself twice to all whom he knows: here the same goes
// to an address twice, and then once in an interval. And while one reader lacks something, all that
// are matched are asked whether they do, also those that never answer: here only who has a reliable
// reader that has not said so since. A newcomer gets all. Any thread.
class Repeats {
public:
    using Clock = std::chrono::steady_clock;
    using Prefix = eprosima::fastrtps::rtps::GuidPrefix_t;
    using Guid = eprosima::fastrtps::rtps::GUID_t;
    using Entity = eprosima::fastrtps::rtps::EntityId_t;
    using Locator = eprosima::fastrtps::rtps::Locator_t;
    using Datagram = std::span<const std::uint8_t>;

    static constexpr int atOnce = 2;

    // `interval`: between the announcements of a participant that has nothing new to say; none:
    // all that discovery says goes out, as a discovery server counts on it.
    Repeats(const Prefix& ours, std::optional<Clock::duration> interval);

    // Whether it is of a kind that is repeated.
    static bool concerns(Datagram sent);
    // Of one that is. `socket` tells ways to the same address apart.
    bool needless(Datagram sent, const void* socket, const Locator& to, Clock::time_point now);
    void heard(Datagram received);

    void newcomer(const Prefix& who, const std::vector<Locator>& at);
    void gone(const Prefix& who);
    // Of others, reliable ones; before it is matched.
    void readerFound(const Guid& reader, const std::string& topic);
    void readerGone(const Guid& reader);
    void writerMade(const Entity& ours, const std::string& topic);
    void writerGone(const Entity& ours);

private:
    using EntityNumber = std::uint32_t;
    struct Announced {
        std::size_t content;
        Clock::time_point paidUntil;
    };
    struct Other {
        std::map<EntityNumber, std::string> topicOf;  // a reader
        // By our writer and a reader: the number after the last that it has said it has.
        std::map<std::pair<EntityNumber, EntityNumber>, std::int64_t> next;

        bool has(EntityNumber writer, std::int64_t last) const;
    };

    bool announcedEnough(Datagram submessage, const void* socket, const Locator& to,
                         Clock::time_point now);

    const Prefix ours_;
    const std::optional<Clock::duration> interval_;
    std::mutex mutex_;
    std::map<std::pair<Locator, const void*>, Announced> announced_;
    std::map<EntityNumber, std::string> writers_;  // ours, and their topics
    std::map<Prefix, Other> others_;
    std::map<Locator, std::set<Prefix>> livesAt_;
};

}  // namespace cortex::comms
