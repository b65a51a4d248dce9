// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/quality.hpp"
#include "cortex/core/realtime.hpp"
#include "cortex/core/report.hpp"
#include "cortex/core/structure.hpp"

#include <array>
#include <atomic>
#include <concepts>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace cortex {

enum class EventKind : std::uint8_t {
    StateChange,
    Fault,
    Refusal,
    Overflow,
    Limit,
    Conflict,
    Agent,
    Command,
    Watchdog,
    Message,
    Control,     // taken, handed over, released or lost
    Loss,        // of an agent, an input or events, and that it is back
    ValueChange  // only in what an agent keeps of the past: a value that changed its state
};

const char* name(EventKind kind);
std::optional<EventKind> eventKindFromName(std::string_view text);

// Bounded text that is built without allocation; what does not fit is cut.
class EventText {
public:
    static constexpr std::size_t capacity = 150;  // bytes

    EventText() = default;
    EventText(std::string_view text) { *this << text; }                 // NOLINT: reads as a text
    EventText(const char* text) : EventText{std::string_view{text}} {}  // NOLINT

    EventText& operator<<(std::string_view text) CORTEX_REALTIME;
    EventText& operator<<(const char* text) CORTEX_REALTIME;
    EventText& operator<<(std::int64_t number) CORTEX_REALTIME;
    EventText& operator<<(double number) CORTEX_REALTIME;  // six digits, or whole as it is
    // With as many digits as tell it from the other.
    EventText& apart(double number, double other) CORTEX_REALTIME;
    template <std::integral T>
    EventText& operator<<(T number) CORTEX_REALTIME {
        return *this << static_cast<std::int64_t>(number);
    }
    std::string_view view() const { return {text_.data(), length_}; }

private:
    std::array<char, capacity> text_{};
    std::uint16_t length_ = 0;
};

// Sequence numbers of events: begin of the cycle, tasks, end of the cycle. So their order does not
// depend on which thread ran which task.
inline constexpr std::uint32_t taskSequence = 1U << 20U, endSequence = 1U << 30U;

// One thing that happened in a cycle. Fixed size; the number is given when it is merged.
struct Event {
    std::int64_t cycle = 0;
    std::int64_t time = 0;       // nominal, ns since the cluster's start
    std::int64_t clock = 0;      // the same by monotonicNow(); 0: not known
    std::int64_t wallClock = 0;  // the same in UTC ns; the log sets it
    std::uint64_t number = 0;    // per agent and epoch, from 1
    // Number among the events that the same input causes again, those that were lost on the way
    // included. 0: it came from measured times, or from another thread than those of the loop.
    std::uint64_t repeatable = 0;
    std::uint32_t simplex = noSimplex;
    std::uint32_t order = 0;     // canonical order of the simplex, then `sequence` decide the merge
    std::uint32_t sequence = 0;  // per ring and cycle
    Severity severity = Severity::Info;
    EventKind kind = EventKind::Message;
    EventText text;
};

// Single producer (a loop thread), single consumer (the event thread); full: counts the dropped.
// Holds `capacity` events, rounded up to a power of two; the last quarter is for errors alone.
class EventRing {
public:
    // `orders`: how many canonical orders its events have.
    explicit EventRing(std::uint32_t capacity, std::size_t orders = 1);

    void post(const Event& event) CORTEX_REALTIME;
    std::uint64_t dropped() const { return dropped_.load(std::memory_order_relaxed); }
    bool peek(Event& event) const;  // consumer
    void pop();

    // Between cycles, by the loop's thread. What was posted can be seen from publish() on.
    void publish() CORTEX_REALTIME { visible_.store(tail_, std::memory_order_release); }
    // Repeatable ones that were dropped since the last publish(), by their place in the merge.
    bool hasLost() const CORTEX_REALTIME { return hasLost_; }
    std::uint32_t takeLost(std::size_t place) CORTEX_REALTIME {
        return std::exchange(lost_[place], 0);
    }
    std::size_t places() const CORTEX_REALTIME { return lost_.size(); }
    // Numbers what is not published yet: `before` each place so many were lost, `all` together.
    void countLost(std::span<const std::uint32_t> before, std::uint64_t all) CORTEX_REALTIME;

private:
    std::size_t placeOf(const Event& event) const CORTEX_REALTIME;

    std::vector<Event> events_;
    std::vector<std::uint32_t> lost_;  // producer
    alignas(64) std::atomic<std::uint64_t> head_{0};
    alignas(64) std::atomic<std::uint64_t> visible_{0};
    std::atomic<std::uint64_t> dropped_{0};
    std::uint64_t tail_ = 0;        // producer
    std::uint64_t lostBefore_ = 0;  // in all cycles before, of all rings
    bool hasLost_ = false;
};

class EventFold;

// Merges the rings of all loop threads by cycle, canonical order and sequence, numbers the events
// and hands them to the sinks, on a thread of its own. Ring 0 is the loop thread's.
class EventLog {
public:
    using Sink = std::function<void(const Event&, const Structure&)>;
    enum class Repeats : std::uint8_t { Each, Folded };  // folded: the first, then counts

    EventLog(std::shared_ptr<const Structure> structure, std::uint32_t rings,
             std::uint32_t capacity);
    ~EventLog();

    void addSink(Sink sink, Repeats repeats = Repeats::Each);  // setup only
    void start();
    void stop();  // ends the thread and hands out what is left; idempotent
    EventRing& ring(std::uint32_t index) { return *rings_[index]; }
    // Loop thread: all events of cycles up to this one are in the rings.
    void complete(std::int64_t cycle) CORTEX_REALTIME;
    // Any non-loop thread: an event outside the cycles (watchdog, refused real-time set-up).
    void postOutside(Event event);
    std::uint64_t dropped() const;
    // Hands out all complete events now, on the calling thread; for tests and manual stepping. Not
    // from a sink.
    void flush();

private:
    void run();
    bool handOut(std::int64_t upTo);  // whether there were any
    void handOnInOrder();
    void handOn(Event& event, std::int64_t offset);  // of UTC, ns
    void addDrops();
    void countLost() CORTEX_REALTIME;

    std::shared_ptr<const Structure> structure_;
    std::vector<std::unique_ptr<EventRing>> rings_;
    std::vector<Sink> sinks_, foldedSinks_;
    std::vector<std::uint32_t> lostBefore_;  // loop thread
    std::atomic<std::int64_t> complete_{-1};
    std::thread thread_;

    std::mutex mutex_;  // guards the next three
    std::condition_variable wake_;
    std::vector<Event> outside_;
    bool stopping_ = false;

    std::mutex merging_;  // guards the rest, and the rings' consumer end
    std::vector<Event> batch_, batchOutside_;
    std::unique_ptr<EventFold> fold_;
    std::uint64_t number_ = 0, repeatable_ = 0;
    std::uint64_t reportedDrops_ = 0;
    std::int64_t lastCycle_ = 0, lastTime_ = 0;
};

// One line without its end; `wallClock`: UTC ns of the event. Control characters are escaped.
// "2026-11-20T10:00:00.123Z warning /arm/axis1 position clamped to 2.96 rad"
std::string lineOf(const Event& event, const Structure& structure, std::int64_t wallClock);

}  // namespace cortex
