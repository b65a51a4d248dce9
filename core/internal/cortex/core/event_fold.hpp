// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/event.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <tuple>

namespace cortex {

// Hands the first of equal events on at once, and counts those that follow: each second one event
// says how many there were. Texts that differ only in numbers are equal. So are commands of one
// sender to one simplex that are done and differ only in numbers, and any two of them that set
// items. Faults, errors, changes of state, and commands that fail are never folded. Numbers what it
// hands on. One thread at a time.
class EventFold {
public:
    using Out = std::function<void(const Event&)>;

    explicit EventFold(Out out) : out_{std::move(out)} {}

    void take(const Event& event, std::int64_t now);  // ns
    void pass(std::int64_t now);                      // tells the counts of seconds that are over

private:
    using Key = std::tuple<std::uint32_t, EventKind, Severity, std::string>;
    struct Folded {
        std::int64_t since = 0;
        std::int64_t count = 0;  // that were not handed on
        Event last;
    };
    void handOn(Event event);
    void tell(const Folded& folded);

    Out out_;
    std::map<Key, Folded> open_;
    std::uint64_t number_ = 0;
};

}  // namespace cortex
