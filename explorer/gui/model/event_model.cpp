// SPDX-License-Identifier: Apache-2.0
#include "model/event_model.hpp"

#include "model/plain_text.hpp"
#include "model/shown_time.hpp"
#include "session/utc_now.hpp"

#include <algorithm>
#include <array>
#include <tuple>

namespace cortex::gui {

namespace {

constexpr std::size_t mostOpen = 10'000, mostKinds = 64, mostStarts = 10'000;

}  // namespace

void EventModel::add(std::vector<comms::AgentEvent> events) {
    if (events.empty()) return;
    count_ += events.size();
    std::vector<EventRow> fresh;
    std::set<std::size_t> changed;
    for (EventRow& row : withGaps(std::move(events))) place(std::move(row), fresh, changed);
    for (const std::size_t each : changed) {
        const auto row = static_cast<int>(each);
        Q_EMIT dataChanged(index(row, 0), index(row, ColumnCount - 1));
    }
    append(std::move(fresh));
    drop();
}

// As they came, an agent's numbers rise by one; the rows are by time.
std::vector<EventRow> EventModel::withGaps(std::vector<comms::AgentEvent> events) {
    std::vector<EventRow> rows;
    rows.reserve(events.size());
    for (comms::AgentEvent& event : events) {
        if (event.number == 0) {  // the window's own, such as of a lost agent
            rows.emplace_back(std::move(event));
            continue;
        }
        if (last_.size() > mostStarts) last_.clear();
        const auto [last, isFirst] = last_.try_emplace(Start{event.agent, event.epoch});
        comms::AgentEvent& before = last->second;
        if (!isFirst && event.number > before.number + 1) {
            rows.push_back(EventRow::gap(before, event.number - before.number - 1));
        }
        if (isFirst || event.number > before.number) {
            before = event;
            before.text.clear();
        }
        if (past_.contains({event.agent, event.epoch, event.number})) {
            --count_;
            continue;
        }
        rows.emplace_back(std::move(event));
    }
    // What is missing stands behind the last one that came.
    std::ranges::sort(rows, {}, [](const EventRow& each) {
        const comms::AgentEvent& event = each.event;
        return std::tie(event.wallClock, event.agent, event.number, each.missing, event.text);
    });
    return rows;
}

void EventModel::place(EventRow row, std::vector<EventRow>& fresh, std::set<std::size_t>& changed) {
    if (row.mayFold()) {
        const std::uint64_t next = first_ + rows_.size() + fresh.size();
        const auto [open, isNew] = open_.try_emplace(row.key(), next);
        if (!isNew && open->second >= first_) {
            const std::size_t at = open->second - first_;
            EventRow& other = at < rows_.size() ? rows_[at] : fresh[at - rows_.size()];
            if (other.takes(row.event)) {
                if (at < rows_.size()) release(other);
                other.take(std::move(row.event));
                if (at < rows_.size()) {
                    hold(other);
                    changed.insert(at);
                }
                return;
            }
        }
        open->second = next;
    }
    row.late = !row.isGap() && row.event.wallClock < latest_;
    latest_ = std::max(latest_, row.event.wallClock);
    row.matches = query_.matches(row.event);
    row.kind = kindOf(row.event.kind);
    fresh.push_back(std::move(row));
}

void EventModel::append(std::vector<EventRow> fresh) {
    if (open_.size() > mostOpen) open_.clear();
    if (fresh.empty()) return;
    for (const EventRow& each : fresh) hold(each);
    const auto first = static_cast<int>(rows_.size());
    beginInsertRows({}, first, first + static_cast<int>(fresh.size()) - 1);
    rows_.insert(rows_.end(), std::make_move_iterator(fresh.begin()),
                 std::make_move_iterator(fresh.end()));
    endInsertRows();
}

void EventModel::drop() {
    if (held_ > kept_ && rows_.front().kept && tooMuchChatter(0) > 0) merge({});
    std::size_t gone = 0;
    while (held_ > kept_ && gone + 1 < rows_.size()) {
        const EventRow& row = rows_[gone++];
        release(row);
        past_.erase({row.event.agent, row.event.epoch, row.event.number});
        dropped_ += row.isGap() ? 0 : row.times;
    }
    if (gone == 0) return;
    beginRemoveRows({}, 0, static_cast<int>(gone) - 1);
    rows_.erase(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(gone));
    first_ += gone;
    endRemoveRows();
}

void EventModel::search(EventQuery query) {
    query_ = std::move(query);
    for (EventRow& each : rows_) each.matches = query_.matches(each.event);
}

// What agents call a kind is theirs; beyond a number that no agent has, all are one kind.
std::size_t EventModel::kindOf(const std::string& kind) {
    const auto found = std::ranges::find(kinds_, kind);
    if (found != kinds_.end()) return static_cast<std::size_t>(found - kinds_.begin());
    if (kinds_.size() < mostKinds) kinds_.push_back(kind);
    return kinds_.size() - 1;
}

QString EventModel::timeText(std::int64_t utc, bool late) {
    return (late ? QStringLiteral("↑") : QString{}) + shownTimeText(utc, "HH:mm:ss.zzz");
}

int EventModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : static_cast<int>(rows_.size());
}

int EventModel::columnCount(const QModelIndex& /*parent*/) const { return ColumnCount; }

QVariant EventModel::data(const QModelIndex& index, int role) const {
    const bool texts = role == Qt::DisplayRole || role == Qt::AccessibleTextRole;
    if (!index.isValid() || (!texts && role != Qt::ToolTipRole)) return {};
    const EventRow& row = at(index.row());
    const comms::AgentEvent& event = row.event;
    if (role == Qt::ToolTipRole) {
        if (index.column() == Time && row.late) return tr("It came late: see what stands above it");
        return tipText(index.column() == Path ? plainText(event.path) : row.text());
    }
    if (index.column() == Time && role == Qt::AccessibleTextRole && row.late)
        return tr("%1, came late").arg(timeText(event.wallClock));
    switch (index.column()) {
        case Time:
            return timeText(event.wallClock, row.late);
        case SeverityColumn:
            return row.isGap() ? tr("missing") : QString{QLatin1String{name(event.severity)}};
        case Kind:
            return row.isGap() ? QString{} : plainText(event.kind);
        case Path:
            return plainText(event.path);
        case Text:
            return row.text();
        case Times:
            if (row.isGap()) return countText(row.missing);
            return row.times > 1 ? QChar{0xD7} + countText(row.times) : QString{};
        default:
            return plainText(event.agent);
    }
}

QVariant EventModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal) return {};
    if (role == Qt::TextAlignmentRole) {
        const Qt::Alignment side = section == Times ? Qt::AlignRight : Qt::AlignLeft;
        return QVariant::fromValue(side | Qt::AlignVCenter);
    }
    if (role != Qt::DisplayRole) return {};
    const QString time = tr("Time (%1)").arg(zoneName(utcNow()));
    const std::array titles{time,        tr("Severity"), tr("Kind"), tr("Path"),
                            tr("Agent"), tr("What"),     tr("Times")};
    return titles[static_cast<std::size_t>(section)];
}

}  // namespace cortex::gui
