// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/event_memory.hpp"

#include "cortex/core/command_sentence.hpp"
#include "cortex/core/numbered_text.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>

namespace cortex {
namespace {

// Of a hundred entries, by kind: commands and changes of state are many, and asked for most.
constexpr std::array<std::size_t, EventMemory::kinds.size()> percent{10, 20, 30, 10, 10, 10, 5, 5};

// None: chatter.
std::optional<std::size_t> shelfOf(EventKind kind, Severity severity) {
    const auto& kinds = EventMemory::kinds;
    constexpr std::size_t others = kinds.size() - 1;
    static_assert(kinds[others] == EventKind::Message);
    const auto found = std::ranges::find(kinds.begin(), kinds.begin() + others, kind);
    const auto shelf = static_cast<std::size_t>(found - kinds.begin());
    if (shelf < others || severity == Severity::Error) return shelf;
    return {};
}

// "cortex@desk for Ada" of "cortex@desk.4711-5e1f0a for Ada": each run of a tool is a new process.
std::string withoutProcess(std::string_view sender) {
    const std::size_t host = std::min(sender.find('@'), sender.size());
    const std::size_t end = std::min(sender.find(' ', host), sender.size());
    const std::size_t process = std::min(sender.substr(0, end).rfind('.'), end);
    if (process < host) return std::string{sender};
    return std::string{sender.substr(0, process)}.append(sender.substr(end));
}

// Who sent a command; else the path and the words, which are the same again where a number is
// another one.
std::size_t originOf(const KeptEvent& event) {
    const bool isCommand = event.kind == EventKind::Command || event.kind == EventKind::Control ||
                           event.kind == EventKind::Refusal;
    const auto sentence = isCommand ? commandSentence(event.text) : std::nullopt;
    return std::hash<std::string>{}(sentence ? withoutProcess(sentence->sender)
                                             : event.path + '\n' +
                                                   withoutDigits(withoutTimes(event.text)));
}

// What was dropped may have the last time there is.
std::int64_t after(std::int64_t time) { return time == EventMemory::always ? time : time + 1; }

}  // namespace

EventMemory::EventMemory(std::size_t entries, std::int64_t begin) {
    for (std::size_t i = 0; i < kept_.size(); ++i) {
        kept_[i].most = std::max<std::size_t>(entries * percent[i] / 100, 1);
        kept_[i].begin = begin;
        kept_[i].since = std::numeric_limits<std::int64_t>::min();
    }
}

std::size_t EventMemory::sizeOf(const KeptEvent& event) {
    return sizeof(KeptEvent) + event.path.size() + event.text.size();
}

void EventMemory::take(const Event& event, const Structure& structure) {
    if (!shelfOf(event.kind, event.severity)) return;
    KeptEvent kept;
    kept.epoch = structure.epoch;
    kept.number = event.number;
    kept.cycle = event.cycle;
    kept.wallClock = event.wallClock;
    kept.severity = event.severity;
    kept.kind = event.kind;
    kept.path = event.simplex < structure.simplexes.size() ? structure.simplexes[event.simplex].path
                                                           : "/" + structure.agent;
    kept.text = event.text.view();
    keep(std::move(kept));
}

std::uint64_t EventMemory::keep(KeptEvent event) { return add(std::move(event), &Kept::events); }

std::uint64_t EventMemory::recall(KeptEvent event) { return add(std::move(event), &Kept::earlier); }

std::uint64_t EventMemory::add(KeptEvent event, Entries Kept::* where) {
    const auto shelf = shelfOf(event.kind, event.severity);
    if (!shelf) return 0;
    const std::lock_guard lock{mutex_};
    Kept& kept = kept_[*shelf];
    event.place = ++place_;
    const std::size_t size = sizeOf(event), origin = originOf(event);
    kept.bytes += size;
    kept.shares[origin] += size;
    (kept.*where).push_back({std::move(event), origin});
    const auto isFull = [&kept](std::size_t entries) {
        return entries > kept.most || kept.bytes > kept.most * bytesOfEntry;
    };
    for (std::size_t entries = kept.earlier.size() + kept.events.size();
         entries > 1 && isFull(entries); --entries) {
        kept.drop();
    }
    return place_;
}

// The newest of this start stays in any case.
void EventMemory::Kept::drop() {
    const auto hasTooMuch = [this](const Entry& each) {
        return shares[each.origin] > bytes / 4 && (events.empty() || &each != &events.back());
    };
    Entries* where = earlier.empty() ? &events : &earlier;
    auto found = where->begin();
    for (Entries* each : {&earlier, &events}) {
        const auto first = std::ranges::find_if(*each, hasTooMuch);
        if (first == each->end()) continue;
        where = each;
        found = first;
        break;
    }
    since = std::max(since, after(found->wallClock));
    const std::size_t size = sizeOf(*found);
    bytes -= size;
    const auto share = shares.find(found->origin);
    share->second -= size;
    if (share->second == 0) shares.erase(share);
    where->erase(found);
}

EventMemory::Page EventMemory::page(std::uint64_t place, std::int64_t from, std::int64_t until,
                                    std::size_t bytes) const {
    using Position = Entries::const_iterator;
    const std::lock_guard lock{mutex_};
    std::vector<std::pair<Position, Position>> runs;
    for (const Kept& each : kept_) {
        for (const auto* events : {&each.earlier, &each.events}) {
            const auto first = std::ranges::upper_bound(*events, place, {}, &KeptEvent::place);
            runs.emplace_back(first, events->end());
        }
    }
    const auto next = [&]() -> Position* {
        Position* first = nullptr;
        for (auto& [each, end] : runs) {
            while (each != end && (each->wallClock < from || each->wallClock > until)) ++each;
            if (each != end && (first == nullptr || each->place < (*first)->place)) first = &each;
        }
        return first;
    };
    Page page;
    std::size_t size = 0;
    for (Position* each = next(); each != nullptr; each = next()) {
        size += sizeOf(**each);
        page.more = size > bytes && !page.events.empty();
        if (page.more) break;
        page.events.push_back(**each);
        ++*each;
    }
    return page;
}

EventMemory::Times EventMemory::since() const {
    const std::lock_guard lock{mutex_};
    Times since{};
    std::ranges::transform(kept_, since.begin(),
                           [](const Kept& each) { return std::max(each.begin, each.since); });
    return since;
}

void EventMemory::goOn(const Times& since) {
    const std::lock_guard lock{mutex_};
    for (std::size_t i = 0; i < kept_.size(); ++i) kept_[i].begin = since[i];
}

std::size_t EventMemory::bytes() const {
    const std::lock_guard lock{mutex_};
    return std::accumulate(kept_.begin(), kept_.end(), std::size_t{0},
                           [](std::size_t sum, const Kept& each) { return sum + each.bytes; });
}

}  // namespace cortex
