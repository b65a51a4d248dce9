// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/event_fold.hpp"

#include "cortex/core/command_sentence.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cortex {
namespace {

constexpr std::int64_t foldedFor = 1'000'000'000;  // ns
constexpr std::size_t mostOpen = 1'000;

constexpr std::array foldedKinds{EventKind::Refusal,  EventKind::Overflow, EventKind::Limit,
                                 EventKind::Conflict, EventKind::Agent,    EventKind::Message,
                                 EventKind::Loss};

bool isDone(const Event& event) {
    const bool ran = event.kind == EventKind::Command || event.kind == EventKind::Control;
    if (!ran || event.severity != Severity::Info) return false;
    const auto sentence = commandSentence(event.text.view());
    return sentence && sentence->done;
}

bool mayFold(const Event& event) {
    const bool kind = std::ranges::find(foldedKinds, event.kind) != foldedKinds.end();
    return isDone(event) || (kind && event.severity != Severity::Error);
}

// Without its numbers: two that missed 3 and 5 ticks are the same event again. Whoever sent a
// command that was refused is another one where only numbers differ.
std::string wordsOf(std::string_view text) {
    std::string words;
    if (const auto sentence = commandSentence(text)) {
        words = sentence->sender;
        text.remove_prefix(sentence->sender.size());
    }
    for (const char each : text) {
        if (std::isdigit(static_cast<unsigned char>(each)) == 0) words += each;
    }
    return words;
}

// The sender and the command. Those that differ in numbers are one run, and any two that set items.
std::string runOf(std::string_view text) {
    const CommandSentence sentence = *commandSentence(text);
    std::string run{sentence.sender};
    run.append(": ").append(sentence.command);
    if (sentence.command == "set") return run;
    char before = '\0';
    for (const char each : sentence.arguments) {
        const bool digit = std::isdigit(static_cast<unsigned char>(each)) != 0;
        const bool exponent = each == 'e' && before == '0';
        if (!digit && !exponent && each != '.' && each != '-' && each != '+') run += each;
        before = digit ? '0' : each;
    }
    return run;
}

}  // namespace

void EventFold::take(const Event& event, std::int64_t now) {
    pass(now);
    if (!mayFold(event)) return handOn(event);
    const std::string_view text = event.text.view();
    const Key key{event.simplex, event.kind, event.severity,
                  isDone(event) ? runOf(text) : wordsOf(text)};
    const auto found = open_.find(key);
    if (found != open_.end()) {
        ++found->second.count;
        found->second.last = event;
        return;
    }
    if (open_.size() < mostOpen) open_[key] = {now, 0, event};
    handOn(event);
}

// A second in which nothing was counted ends the folding. Of those that are told, the oldest first.
void EventFold::pass(std::int64_t now) {
    std::vector<Folded*> due;
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
        due.push_back(&folded);
        ++each;
    }
    std::ranges::sort(due, {}, [](const Folded* each) {
        return std::pair{each->last.wallClock, each->last.number};
    });
    for (Folded* each : due) {
        tell(*each);
        each->since = now;
        each->count = 0;
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
