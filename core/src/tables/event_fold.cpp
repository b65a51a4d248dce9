// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/event_fold.hpp"

#include "cortex/core/command_sentence.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

namespace cortex {
namespace {

constexpr std::int64_t foldedFor = 1'000'000'000;  // ns
constexpr std::size_t mostOpen = 1'000;

constexpr std::array foldedKinds{EventKind::Refusal,  EventKind::Overflow, EventKind::Limit,
                                 EventKind::Conflict, EventKind::Agent,    EventKind::Message,
                                 EventKind::Loss};

std::optional<CommandSentence> sentenceOf(const Event& event) {
    const bool tells = event.kind == EventKind::Command || event.kind == EventKind::Control ||
                       event.kind == EventKind::Refusal;
    return tells ? commandSentence(event.text.view()) : std::nullopt;
}

// What was cut off may have been another word.
bool isWhole(const CommandSentence& sentence) {
    return !sentence.outcome.empty() && !sentence.arguments.ends_with("…");
}

bool mayFold(const Event& event) {
    if (const auto sentence = sentenceOf(event)) {
        const bool folds = sentence->done || event.kind == EventKind::Refusal;
        return folds && event.severity != Severity::Error && isWhole(*sentence);
    }
    const bool kind = std::ranges::find(foldedKinds, event.kind) != foldedKinds.end();
    return kind && event.severity != Severity::Error;
}

}  // namespace

std::string EventFold::keyOf(const Event& event) const {
    const auto sentence = sentenceOf(event);
    // Two that missed 3 and 5 ticks are the same event again.
    if (!sentence) return withoutDigits(event.text.view());
    const bool repeated = isRepeated_(event.simplex, sentence->command);
    std::string key{sentence->sender};
    key.append(": ").append(sentence->command).append("(");
    key += repeated ? numberedText(sentence->arguments).words : std::string{sentence->arguments};
    key += "): ";
    return key + (repeated ? withoutDigits(sentence->outcome) : std::string{sentence->outcome});
}

void EventFold::take(const Event& event, std::int64_t now) {
    pass(now);
    if (!mayFold(event)) return handOn(event);
    const Key key{event.simplex, event.kind, event.severity, keyOf(event)};
    const auto found = open_.find(key);
    if (found != open_.end()) return count(found->second, event);
    if (open_.size() < mostOpen) open_[key] = {now, 0, event, {}};
    handOn(event);
}

void EventFold::count(Folded& folded, const Event& event) const {
    ++folded.count;
    folded.last = event;
    const auto sentence = sentenceOf(event);
    if (!sentence || !isRepeated_(event.simplex, sentence->command)) return;
    std::size_t place = 0;
    for (const std::string& each : numberedText(sentence->arguments).numbers) {
        if (place == folded.ranges.size()) folded.ranges.emplace_back(each);
        folded.ranges[place++].take(each);
    }
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
        each->ranges.clear();
    }
}

// What was told meanwhile stands before it.
void EventFold::tell(const Folded& folded) {
    Event event = folded.last;
    const std::int64_t late = newest_ - event.wallClock;
    if (late > 0 && late < 2 * foldedFor) event.wallClock = newest_;
    if (folded.count == 1) return handOn(event);
    EventText times;
    times << folded.count << timesWithinASecond;
    const std::string ranged = withRanges(folded);
    const bool fits = times.view().size() + ranged.size() <= EventText::capacity;
    event.text = times;
    event.text << (fits ? std::string_view{ranged} : folded.last.text.view());
    handOn(event);
}

// "desk: jog(axis=1, speed=0.5 (-0.5 to 0.7)): Done in 1 cycle"
std::string EventFold::withRanges(const Folded& folded) {
    const std::string_view last = folded.last.text.view();
    if (folded.ranges.empty()) return std::string{last};
    const std::string_view arguments = sentenceOf(folded.last)->arguments;
    const auto begin = static_cast<std::size_t>(arguments.data() - last.data());
    std::string text{last.substr(0, begin)};
    std::size_t place = 0;
    for (const char each : numberedText(arguments).words) {
        if (each != numberSign) {
            text += each;
            continue;
        }
        const NumberRange& range = folded.ranges[place++];
        text += range.last;
        if (!range.isOne()) text += " (" + range.least + " to " + range.greatest + ")";
    }
    return text.append(last.substr(begin + arguments.size()));
}

void EventFold::handOn(Event event) {
    event.number = ++number_;
    newest_ = std::max(newest_, event.wallClock);
    out_(event);
}

}  // namespace cortex
