// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/event_fold.hpp"

#include "cortex/core/command_sentence.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace cortex {
namespace {

constexpr std::int64_t foldedFor = 1'000'000'000;  // ns
constexpr std::size_t mostOpen = 1'000;

constexpr std::array foldedKinds{EventKind::Refusal,  EventKind::Overflow, EventKind::Limit,
                                 EventKind::Conflict, EventKind::Agent,    EventKind::Message,
                                 EventKind::Loss};

bool isOfCommand(EventKind kind) {
    return kind == EventKind::Command || kind == EventKind::Control || kind == EventKind::Refusal;
}

std::optional<CommandSentence> sentenceOf(const Event& event) {
    return isOfCommand(event.kind) ? commandSentence(event.text.view()) : std::nullopt;
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

bool isOver(std::int64_t since, std::int64_t now) {
    return now == std::numeric_limits<std::int64_t>::max() || now - since >= foldedFor;
}

// How the numbers of a repeated command are told beside the last ones.
enum class Ranges { OfEach, OfArrays, Alone };
// The first one for which there is room. `outcome`: how much of what became of it has to fit.
struct Form {
    Ranges ranges;
    std::size_t outcome;
};
constexpr std::array forms{Form{Ranges::OfEach, EventText::capacity},
                           Form{Ranges::OfArrays, EventText::capacity}, Form{Ranges::OfArrays, 24},
                           Form{Ranges::Alone, 0}};

std::string bracket(const NumberRange& range, std::string_view before) {
    return std::string{" ("}.append(before) + range.least + " to " + range.greatest + ")";
}

bool areOne(std::span<const NumberRange> ranges) {
    return std::ranges::all_of(ranges, &NumberRange::isOne);
}

NumberRange joined(std::span<const NumberRange> ranges) {
    NumberRange all = ranges.front();
    for (const NumberRange& each : ranges) {
        all.take(each.least);
        all.take(each.greatest);
    }
    return all;
}

// "axis=1, speed=0.5 (-0.5 to 0.7)"; of an array "speed=0.5 0 (each -0.5 to 0.7)".
std::string argumentsWithRanges(std::string_view arguments, std::span<const NumberRange> ranges,
                                Ranges which) {
    if (which == Ranges::Alone) {
        std::vector<NumberRange> differing;
        std::ranges::copy_if(ranges, std::back_inserter(differing),
                             std::not_fn(&NumberRange::isOne));
        const NumberRange all = joined(differing);
        return "…, numbers " + all.least + " to " + all.greatest;
    }
    const std::string words = numberedText(arguments).words;
    const std::string goesOn{' ', numberSign};
    std::string text;
    std::size_t first = 0, place = 0;  // of the array, of the number
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i] != numberSign) {
            text += words[i];
            continue;
        }
        text += ranges[place++].last;
        if (which == Ranges::OfArrays && words.compare(i + 1, goesOn.size(), goesOn) == 0) continue;
        const auto array = ranges.subspan(first, place - first);
        if (!areOne(array)) text += bracket(joined(array), array.size() > 1 ? "each " : "");
        first = place;
    }
    return text;
}

// "desk: jog(axis=1, speed=0.5 (-0.5 to 0.7)): Done in 1 cycle"
std::string withRanges(std::string_view last, std::span<const NumberRange> ranges, Ranges which) {
    const std::string_view arguments = commandSentence(last)->arguments;
    const auto begin = static_cast<std::size_t>(arguments.data() - last.data());
    return std::string{last.substr(0, begin)}
        .append(argumentsWithRanges(arguments, ranges, which))
        .append(last.substr(begin + arguments.size()));
}

std::size_t placeOfOutcome(std::string_view text) {
    const std::string_view outcome = commandSentence(text)->outcome;
    return static_cast<std::size_t>(outcome.data() - text.data());
}

}  // namespace

bool EventFold::isRepeated(const Event& event) const {
    const auto sentence = sentenceOf(event);
    return sentence && isRepeated_(event.simplex, sentence->command);
}

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
    const Key key{event.simplex, event.kind, event.severity, keyOf(event)};
    const auto found = mayFold(event) ? open_.find(key) : open_.end();
    if (found != open_.end()) return count(found->second, event);
    begin(event, key, now);
    handOn(event);
}

void EventFold::begin(const Event& event, const Key& key, std::int64_t now) {
    const bool repeated = isRepeated(event);
    if (isOfCommand(event.kind)) {
        tell(now, true);
        if (!repeated) endRunsOfCommands();
    }
    if (mayFold(event) && open_.size() < mostOpen) open_[key] = {now, 0, repeated, event, {}};
}

// After another one the same command is told again.
void EventFold::endRunsOfCommands() {
    std::erase_if(open_, [](const auto& each) {
        const auto& [key, folded] = each;
        return isOfCommand(folded.last.kind) && !folded.repeated;
    });
}

void EventFold::count(Folded& folded, const Event& event) {
    ++folded.count;
    folded.last = event;
    if (!folded.repeated) return;
    std::size_t place = 0;
    for (const std::string& each : numberedText(sentenceOf(event)->arguments).numbers) {
        if (place == folded.ranges.size()) folded.ranges.emplace_back(each);
        folded.ranges[place++].take(each);
    }
}

// A second in which nothing was counted ends the folding.
void EventFold::pass(std::int64_t now) {
    std::erase_if(open_, [now](const auto& each) {
        return each.second.count == 0 && isOver(each.second.since, now);
    });
    const bool commands = std::ranges::any_of(open_, [now](const auto& each) {
        return isOfCommand(each.second.last.kind) && isOver(each.second.since, now);
    });
    tell(now, commands);
}

// Those whose second is over, and of `commands` all, so that these stay in order. The oldest first.
void EventFold::tell(std::int64_t now, bool commands) {
    std::vector<Folded*> due;
    for (auto& [key, folded] : open_) {
        const bool isDue = isOver(folded.since, now) || (commands && isOfCommand(folded.last.kind));
        if (folded.count > 0 && isDue) due.push_back(&folded);
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
    std::string text{folded.last.text.view()};
    if (!areOne(folded.ranges)) {
        const std::string_view last = folded.last.text.view();
        const std::size_t behind = last.size() - placeOfOutcome(last);
        for (const auto& [ranges, outcome] : forms) {
            text = withRanges(last, folded.ranges, ranges);
            const std::size_t cut = behind - std::min(behind, outcome);
            if (times.view().size() + text.size() <= EventText::capacity + cut) break;
        }
    }
    event.text = times << text;
    handOn(event);
}

void EventFold::handOn(Event event) {
    event.number = ++number_;
    newest_ = std::max(newest_, event.wallClock);
    out_(event);
}

}  // namespace cortex
