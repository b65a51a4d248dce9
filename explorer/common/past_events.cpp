// SPDX-License-Identifier: Apache-2.0
#include "common/past_events.hpp"

#include "cortex/core/command_sentence.hpp"
#include "cortex/core/path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

namespace cortex::common {
namespace {

using Since = comms::PastEvents::Since;

// Of two in order of time; what others say can be any time.
std::uint64_t nanosecondsBetween(const comms::AgentEvent& one, const comms::AgentEvent& next) {
    return static_cast<std::uint64_t>(next.wallClock) - static_cast<std::uint64_t>(one.wallClock);
}

std::string manyOf(const std::string& kind) {
    using Pair = std::pair<std::string_view, const char*>;
    constexpr std::array<Pair, 8> words{
        Pair{"fault", "faults"}, {"state change", "state changes"}, {"command", "commands"},
        {"refusal", "refusals"}, {"control", "changes of control"}, {"loss", "losses"},
        {"value", "values"},     {"message", "other errors"}};
    const auto found = std::ranges::find(words, kind, &Pair::first);
    return found != words.end() ? found->second : kind;
}

// "commands", "commands and values", "faults, commands and values".
std::string listed(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0) text += i + 1 == words.size() ? " and " : ", ";
        text += words[i];
    }
    return text;
}

// Up to this character. Of one that was cut off that which is above it.
std::string_view pathIn(std::string_view text, char end) {
    const std::size_t size = text.find(end);
    if (size != std::string_view::npos) return text.substr(0, size);
    const std::size_t slash = text.rfind('/');
    return text.substr(0, slash != std::string_view::npos ? slash : 0);
}

// What an event of kind control is about; none: it does not say it. Agents write it in
// Router::report() and Router::controlLost().
std::optional<std::string_view> controlledPath(std::string_view text) {
    constexpr std::string_view parameter = "prefix=\"", lost = " no longer has control of ";
    if (const auto sentence = commandSentence(text)) {
        const std::string_view arguments = sentence->arguments;
        if (!arguments.starts_with(parameter)) return std::nullopt;
        return pathIn(arguments.substr(parameter.size()), '"');
    }
    const std::size_t at = text.rfind(lost);
    if (at == std::string_view::npos) return std::nullopt;
    return pathIn(text.substr(at + lost.size()), ':');
}

}  // namespace

bool concerns(const comms::AgentEvent& event, const std::string& prefix) {
    if (isAtOrBelow(event.path, prefix)) return true;
    if (event.kind != "control") return false;
    const auto path = controlledPath(event.text);
    return path && (isAtOrBelow(*path, prefix) || isAtOrBelow(prefix, *path));
}

void sortByTime(AgentEvents& events) {
    std::ranges::sort(events, {}, [](const comms::AgentEvent& event) {
        return std::tuple{event.wallClock, event.number, std::string_view{event.agent}};
    });
}

AgentEvents merged(AgentEvents kept, AgentEvents live) {
    using Key = std::tuple<std::string, std::int64_t, std::uint64_t>;
    const auto keyOf = [](const comms::AgentEvent& event) {
        return Key{event.agent, event.epoch, event.number};
    };
    std::set<Key> there;
    for (const comms::AgentEvent& each : live) there.insert(keyOf(each));
    for (comms::AgentEvent& each : kept) {
        if (each.number == 0 || there.insert(keyOf(each)).second) live.push_back(std::move(each));
    }
    sortByTime(live);
    return live;
}

std::string keptText(std::vector<Since> since, std::int64_t from, std::int64_t epoch,
                     const std::function<std::string(std::int64_t)>& timeText) {
    constexpr double aMoment = 2e9;  // longer ago is an earlier start, whose memory was read
    const std::size_t all = since.size();
    std::erase_if(since, [&](const Since& each) { return each.time <= from; });
    if (since.empty()) return "";
    constexpr std::int64_t millisecond = 1'000'000;
    std::map<std::int64_t, std::vector<std::string>, std::greater<>> kinds;  // by time
    for (const Since& each : since) kinds[each.time / millisecond].push_back(manyOf(each.kind));
    const bool none = since.size() == all;  // is kept as long as that
    const auto oldest = std::prev(kinds.end());
    if (none && all > 1 && kinds.size() == 1) {
        const double begun = static_cast<double>(since.back().time);
        const bool atStart = std::abs(begun - 1000 * static_cast<double>(epoch)) < aMoment;
        return "keeps what happened since " + timeText(oldest->first * millisecond) +
               (atStart ? ", when it started" : "");
    }
    if (none && oldest->second.size() > 1) oldest->second = {"all else"};
    std::string text;
    for (const auto& [time, names] : kinds) {
        const bool begun = !text.empty();
        text += (begun ? ", " : "") + listed(names) + (begun ? " since " : " are kept since ") +
                timeText(time * millisecond);
    }
    return text + "; older ones are not kept";
}

std::optional<FaultChain> newestFaults(const AgentEvents& byTime, const std::string& prefix) {
    std::optional<FaultChain> chain;
    for (std::size_t i = byTime.size(); i-- > 0;) {
        const comms::AgentEvent& each = byTime[i];
        if (each.kind != "fault" || !isAtOrBelow(each.path, prefix)) continue;
        if (!chain) chain = FaultChain{i, i, 0};
        if (nanosecondsBetween(each, byTime[chain->newest]) > chainTime) break;
        chain->first = i;
        ++chain->faults;
    }
    return chain;
}

std::int64_t timeBefore(std::int64_t time, std::int64_t nanoseconds) {
    const std::int64_t first = std::numeric_limits<std::int64_t>::min();
    return time < first + nanoseconds ? first : time - nanoseconds;
}

AgentEvents beforeEvent(const AgentEvents& byTime, std::size_t place, std::int64_t nanoseconds) {
    const std::int64_t begin = timeBefore(byTime[place].wallClock, nanoseconds);
    const auto first = std::ranges::lower_bound(byTime, begin, {}, &comms::AgentEvent::wallClock);
    return {first, byTime.begin() + static_cast<std::ptrdiff_t>(place) + 1};
}

std::string secondsBefore(const comms::AgentEvent& event, const comms::AgentEvent& later) {
    const std::uint64_t milliseconds = nanosecondsBetween(event, later) / 1'000'000;
    const std::string parts = std::to_string(1000 + milliseconds % 1000).substr(1);
    const std::string sign = milliseconds > 0 ? "-" : "";
    return sign + std::to_string(milliseconds / 1000) + '.' + parts + " s";
}

}  // namespace cortex::common
