// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/event_fold.hpp"

#include "cortex/core/command_sentence.hpp"
#include "cortex/core/value.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
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

// Without its numbers: two that missed 3 and 5 ticks are the same event again.
std::string wordsOf(std::string_view text) {
    std::string words;
    for (const char each : text) {
        if (std::isdigit(static_cast<unsigned char>(each)) == 0) words += each;
    }
    return words;
}

// A number among arguments, or what stands between two of them.
struct Piece {
    std::string_view text;
    std::optional<double> number;
};

// "axis=1, speed=-0.5, tool=\"T4\"": 1 and -0.5 are numbers, what stands in quotes is none.
std::vector<Piece> piecesOf(std::string_view arguments) {
    constexpr std::string_view separators = " ,=()\"";
    std::vector<Piece> pieces;
    bool quoted = false;
    while (!arguments.empty()) {
        std::size_t size = std::min(arguments.find_first_of(separators), arguments.size());
        std::optional<double> number;
        if (size > 0 && !quoted) number = toFloat(arguments.substr(0, size));
        if (number && !std::isfinite(*number)) number.reset();
        if (size == 0) {
            if (arguments.front() == '"') quoted = !quoted;
            size = 1;
        }
        pieces.push_back({arguments.substr(0, size), number});
        arguments.remove_prefix(size);
    }
    return pieces;
}

std::string skeletonOf(std::string_view arguments) {
    std::string text;
    for (const Piece& each : piecesOf(arguments)) text += each.number ? "#" : each.text;
    return text;
}

}  // namespace

std::string EventFold::keyOf(const Event& event) const {
    const auto sentence = sentenceOf(event);
    if (!sentence) return wordsOf(event.text.view());
    const bool repeated = isRepeated_(event.simplex, sentence->command);
    std::string key{sentence->sender};
    key.append(": ").append(sentence->command).append("(");
    key += repeated ? skeletonOf(sentence->arguments) : std::string{sentence->arguments};
    key += "): ";
    return key + (repeated ? wordsOf(sentence->outcome) : std::string{sentence->outcome});
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
    for (const Piece& each : piecesOf(sentence->arguments)) {
        if (!each.number) continue;
        const double number = *each.number;
        const std::string text{each.text};
        if (place == folded.ranges.size()) folded.ranges.push_back({number, number, text, text});
        Range& range = folded.ranges[place++];
        if (number < range.least) std::tie(range.least, range.leastText) = std::tie(number, text);
        if (number > range.greatest)
            std::tie(range.greatest, range.greatestText) = std::tie(number, text);
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
    times << folded.count << " times within a second: ";
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
    for (const Piece& each : piecesOf(arguments)) {
        text += each.text;
        if (!each.number) continue;
        const Range& range = folded.ranges[place++];
        if (range.least < range.greatest)
            text += " (" + range.leastText + " to " + range.greatestText + ")";
    }
    return text.append(last.substr(begin + arguments.size()));
}

void EventFold::handOn(Event event) {
    event.number = ++number_;
    newest_ = std::max(newest_, event.wallClock);
    out_(event);
}

}  // namespace cortex
