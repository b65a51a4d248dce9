// SPDX-License-Identifier: Apache-2.0
// What agents have kept, among the events that came.
#include "model/event_key.hpp"
#include "model/event_model.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

namespace cortex::gui {

namespace {

std::size_t heldBy(const EventRow& row) { return 1 + row.others.size(); }

auto orderOf(const EventRow& row) {
    const comms::AgentEvent& event = row.event;
    return std::tie(event.wallClock, event.agent, event.number);
}

}  // namespace

void EventModel::hold(const EventRow& row) {
    held_ += heldBy(row);
    if (!row.kept) chatter_ += heldBy(row);
}

void EventModel::release(const EventRow& row) {
    held_ -= heldBy(row);
    if (!row.kept) chatter_ -= heldBy(row);
}

std::optional<std::uint64_t> EventModel::renumbered(std::uint64_t serial) const {
    if (!renumbers()) return serial;
    const std::uint64_t before = first_ + rows_.size() - places_.size();  // as the end has stayed
    if (serial < before || serial - before >= places_.size()) return std::nullopt;
    const auto& place = places_[serial - before];
    return place ? std::optional{first_ + *place} : std::nullopt;
}

void EventModel::addPast(std::vector<comms::AgentEvent> events) {
    std::vector<EventRow> fresh = unknown(std::move(events));
    if (fresh.empty()) return;
    count_ += fresh.size();
    for (EventRow& each : fresh) {
        const comms::AgentEvent& event = each.event;
        if (event.number > 0) past_.emplace(event.agent, event.epoch, event.number);
        latest_ = std::max(latest_, event.wallClock);
        each.matches = query_.matches(event);
        each.kind = kindOf(event.kind);
    }
    merge(std::move(fresh));
    drop();
}

// Those that are not among the rows, each once, in order of time.
std::vector<EventRow> EventModel::unknown(std::vector<comms::AgentEvent> events) const {
    std::vector<EventKey> known;
    for (const EventRow& row : rows_) {
        if (!row.kept) continue;
        known.push_back(eventKeyOf(row.event));
        for (const comms::AgentEvent& each : row.others) known.push_back(eventKeyOf(each));
    }
    std::ranges::sort(known);
    std::ranges::sort(events, {}, eventKeyOf);
    const auto doubles = std::ranges::unique(events, {}, eventKeyOf);
    events.erase(doubles.begin(), doubles.end());
    std::vector<EventRow> fresh;
    for (comms::AgentEvent& each : events) {
        if (!std::ranges::binary_search(known, eventKeyOf(each)))
            fresh.emplace_back(std::move(each));
    }
    std::ranges::sort(fresh, {}, orderOf);
    return fresh;
}

// Events of chatter that give way where there are too many: a fifth of the room stays theirs.
std::size_t EventModel::tooMuchChatter(std::size_t fresh) const {
    const std::size_t all = held_ + fresh, own = kept_ / 5;
    if (all <= kept_ || chatter_ <= own) return 0;
    return std::min(all - kept_ * 9 / 10, chatter_ - own / 2);
}

// Before the first row of a later time that did not come late: these are in order of time.
void EventModel::merge(std::vector<EventRow> past) {
    std::size_t surplus = tooMuchChatter(past.size());
    const std::uint64_t end = first_ + rows_.size();
    std::deque<EventRow> rows;
    std::vector<std::optional<std::size_t>> places;
    places.reserve(rows_.size());
    auto next = past.begin();
    const auto put = [&] {
        hold(*next);
        rows.push_back(std::move(*next++));
    };
    beginResetModel();
    for (EventRow& row : rows_) {
        while (!row.late && next != past.end() && orderOf(*next) < orderOf(row)) put();
        if (surplus > 0 && !row.kept) {
            surplus -= std::min(surplus, heldBy(row));
            dropped_ += row.isGap() ? 0 : row.times;
            release(row);
            places.emplace_back(std::nullopt);
            continue;
        }
        places.emplace_back(rows.size());
        rows.push_back(std::move(row));
    }
    while (next != past.end()) put();
    rows_ = std::move(rows);
    places_ = std::move(places);
    first_ = end - rows_.size();
    for (auto& [key, serial] : open_) serial = renumbered(serial).value_or(0);
    endResetModel();
    places_.clear();
}

}  // namespace cortex::gui
