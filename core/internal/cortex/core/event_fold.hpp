// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/event.hpp"
#include "cortex/core/numbered_text.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace cortex {

// Hands the first of equal events on at once, and counts those that follow: each second one event
// says how many there were. Texts that differ only in numbers are equal. Commands are only where
// they are the same word for word and no other came between them, or where their type says that a
// held button repeats them: of these the event tells the last arguments, and the ranges of their
// numbers. Faults, errors, changes of state, and commands that fail are never folded. What was
// counted of commands is told before the next command is. Numbers what it hands on, whose times
// never go back for its sake. One thread at a time.
class EventFold {
public:
    using Out = std::function<void(const Event&)>;
    // Whether the type of this simplex says so of this command.
    using IsRepeated = std::function<bool(std::uint32_t simplex, std::string_view command)>;

    EventFold(Out out, IsRepeated isRepeated)
        : out_{std::move(out)}, isRepeated_{std::move(isRepeated)} {}

    void take(const Event& event, std::int64_t now);  // ns
    void pass(std::int64_t now);                      // tells the counts of seconds that are over

private:
    using Key = std::tuple<std::uint32_t, EventKind, Severity, std::string>;
    struct Folded {
        std::int64_t since = 0;
        std::int64_t count = 0;  // that were not handed on
        bool repeated = false;   // a command of a held button
        Event last;
        std::vector<NumberRange> ranges;  // of its numbers
    };
    bool isRepeated(const Event& event) const;
    std::string keyOf(const Event& event) const;
    static void count(Folded& folded, const Event& event);
    void begin(const Event& event, const Key& key, std::int64_t now);
    void endRunsOfCommands();
    void tell(std::int64_t now, bool commands);
    void tell(const Folded& folded);
    void handOn(Event event);

    Out out_;
    IsRepeated isRepeated_;
    std::map<Key, Folded> open_;
    std::uint64_t number_ = 0;
    std::int64_t newest_ = 0;  // wallClock of what was handed on
};

}  // namespace cortex
