// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/event.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

namespace cortex {

// An event that an agent keeps, or what it did not publish: a value that changed its state, or that
// an earlier start ended in a crash.
struct KeptEvent {
    std::uint64_t place = 0;   // in the memory, from 1; it grows with each that is kept
    std::int64_t epoch = 0;    // the start of the agent that wrote it, UTC microseconds
    std::uint64_t number = 0;  // of the event, as others know it; 0: none was published
    std::int64_t cycle = 0, wallClock = 0;  // UTC ns
    Severity severity = Severity::Info;
    EventKind kind = EventKind::Message;
    std::string path, text;
    bool operator==(const KeptEvent&) const = default;
};

// What an agent keeps of the past: faults, changes of state, commands, refusals, control, losses,
// values that changed their state, and errors of all other kinds, under Message. Each has room of
// its own, so a flood of one drives out no other; all else is chatter, which is not kept. In a room
// that is full the oldest goes first of those that have more than a quarter of it: the commands of
// one sender, or what one path says again and again in the same words. Where nothing has so much,
// it is the oldest of all. Any thread; the loop does not use it.
class EventMemory {
public:
    static constexpr std::size_t usualEntries = 20'000;
    static constexpr std::size_t bytesOfEntry = 256;  // on the average, at most
    static constexpr std::array kinds{
        EventKind::Fault,   EventKind::StateChange, EventKind::Command,     EventKind::Refusal,
        EventKind::Control, EventKind::Loss,        EventKind::ValueChange, EventKind::Message};
    using Times = std::array<std::int64_t, kinds.size()>;  // UTC ns, by kind
    static constexpr std::int64_t always = std::numeric_limits<std::int64_t>::max();

    // `entries`: of all kinds together; at least one of each is kept. `begin`: UTC ns from which
    // it keeps what happens.
    explicit EventMemory(std::size_t entries = usualEntries, std::int64_t begin = 0);

    void take(const Event& event, const Structure& structure);  // nothing happens with chatter
    std::uint64_t keep(KeptEvent event);  // gives it its place, and says it; 0: it is chatter
    // The same for what an earlier start has kept: it goes before anything of this start does.
    std::uint64_t recall(KeptEvent event);

    // Those after `place` of this time (UTC ns, both included), in the order in which they came,
    // as many as fit into `bytes` (at least one).
    struct Page {
        std::vector<KeptEvent> events;
        bool more = false;  // behind these
    };
    Page page(std::uint64_t place, std::int64_t from = 0, std::int64_t until = always,
              std::size_t bytes = std::numeric_limits<std::size_t>::max()) const;

    // Everything of a kind from this time on is kept, whatever the clock did meanwhile.
    Times since() const;
    // What is known of earlier starts: it is kept from there on, but for what is dropped here.
    void goOn(const Times& since);

    static std::size_t sizeOf(const KeptEvent& event);  // bytes, as they are counted
    std::size_t bytes() const;                          // of all that is kept

private:
    struct Entry : KeptEvent {
        std::size_t origin = 0;  // hash of who says it
    };
    using Entries = std::deque<Entry>;
    struct Kept {
        std::size_t most = 0;  // entries
        std::size_t bytes = 0;
        std::int64_t begin = 0, since = 0;  // `since`: of what was dropped
        Entries earlier, events;
        std::unordered_map<std::size_t, std::size_t> shares;  // bytes, by origin
        void drop();
    };
    std::uint64_t add(KeptEvent event, Entries Kept::* where);

    mutable std::mutex mutex_;
    std::array<Kept, kinds.size()> kept_;
    std::uint64_t place_ = 0;  // of the newest
};

}  // namespace cortex
