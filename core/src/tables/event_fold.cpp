// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/event_fold.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>

namespace cortex {
namespace {

constexpr std::int64_t foldedFor = 1'000'000'000;  // ns
constexpr std::size_t mostOpen = 1'000;

constexpr std::array foldedKinds{EventKind::Refusal,  EventKind::Overflow, EventKind::Limit,
                                 EventKind::Conflict, EventKind::Agent,    EventKind::Message};

bool mayFold(const Event& event) {
    return event.severity != Severity::Error &&
           std::ranges::find(foldedKinds, event.kind) != foldedKinds.end();
}

// Without its numbers: two that missed 3 and 5 ticks are the same event again.
std::string wordsOf(std::string_view text) {
    std::string words;
    for (const char each : text) {
        if (std::isdigit(static_cast<unsigned char>(each)) == 0) words += each;
    }
    return words;
}

}  // namespace

void EventFold::take(const Event& event, std::int64_t now) {
    pass(now);
    if (!mayFold(event)) return handOn(event);
    const Key key{event.simplex, event.kind, event.severity, wordsOf(event.text.view())};
    const auto found = open_.find(key);
    if (found != open_.end()) {
        ++found->second.count;
        found->second.last = event;
        return;
    }
    if (open_.size() < mostOpen) open_[key] = {now, 0, event};
    handOn(event);
}

// A second in which nothing was counted ends the folding.
void EventFold::pass(std::int64_t now) {
    for (auto each = open_.begin(); each != open_.end();) {
        Folded& folded = each->second;
        if (now < std::numeric_limits<std::int64_t>::max() && now - folded.since < foldedFor) {
            ++each;
            continue;
        }
        if (folded.count == 0) {
            each = open_.erase(each);
            continue;
        }
        tell(folded);
        folded.since = now;
        folded.count = 0;
        ++each;
    }
}

void EventFold::tell(const Folded& folded) {
    Event event = folded.last;
    if (folded.count > 1) {
        event.text = EventText{};
        event.text << folded.count << " times within a second: " << folded.last.text.view();
    }
    handOn(event);
}

void EventFold::handOn(Event event) {
    event.number = ++number_;
    out_(event);
}

}  // namespace cortex
