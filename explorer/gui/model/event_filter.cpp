// SPDX-License-Identifier: Apache-2.0
#include "model/event_filter.hpp"

#include "model/plain_text.hpp"

#include <algorithm>

namespace cortex::explorer {

namespace {

constexpr std::array severities{Severity::Info, Severity::Warning, Severity::Error};

}  // namespace

EventFilter::EventFilter(EventModel& events, QObject* parent)
    : QAbstractTableModel{parent}, events_{events} {
    rebuild();
    connect(&events, &QAbstractItemModel::rowsInserted, this,
            [this](const QModelIndex&, int first, int last) { insert(first, last); });
    connect(&events, &QAbstractItemModel::rowsAboutToBeRemoved, this,
            [this](const QModelIndex&, int, int last) { remove(last); });
    connect(&events, &QAbstractItemModel::dataChanged, this,
            [this](const QModelIndex& first, const QModelIndex& last) {
                tell(first.row(), last.row());
            });
}

int EventFilter::sourceOf(int row) const { return static_cast<int>(serial(row) - events_.first()); }

std::optional<int> EventFilter::rowOf(std::uint64_t serial) const {
    const auto found = std::ranges::lower_bound(shown_, serial);
    if (found == shown_.end() || *found != serial) return std::nullopt;
    return static_cast<int>(found - shown_.begin());
}

bool EventFilter::accepts(const EventRow& row) const {
    if (!row.matches || row.isGap()) return row.matches;
    return shows(row.event.severity) && shows(events_.kinds()[row.kind]) &&
           (showsRoutine_ || !row.isRoutine());
}

void EventFilter::insert(int first, int last) {
    counted_.resize(static_cast<std::size_t>(last) + 1);
    std::vector<std::uint64_t> fresh;
    for (int row = first; row <= last; ++row) {
        count(row);
        if (accepts(events_.at(row))) {
            fresh.push_back(events_.first() + static_cast<std::uint64_t>(row));
        }
    }
    if (fresh.empty()) return;
    const int begin = rowCount();
    beginInsertRows({}, begin, begin + static_cast<int>(fresh.size()) - 1);
    shown_.insert(shown_.end(), fresh.begin(), fresh.end());
    endInsertRows();
}

// The oldest rows go.
void EventFilter::remove(int last) {
    for (int row = 0; row <= last; ++row) {
        add(events_.at(row), 0 - counted_.front());
        counted_.pop_front();
    }
    const std::uint64_t left = events_.first() + static_cast<std::uint64_t>(last) + 1;
    const auto end = std::ranges::lower_bound(shown_, left);
    if (end == shown_.begin()) return;
    beginRemoveRows({}, 0, static_cast<int>(end - shown_.begin()) - 1);
    shown_.erase(shown_.begin(), end);
    endRemoveRows();
}

void EventFilter::tell(int first, int last) {
    for (int row = first; row <= last; ++row) {
        count(row);
        const auto shown = rowOf(events_.first() + static_cast<std::uint64_t>(row));
        if (shown) Q_EMIT dataChanged(index(*shown, 0), index(*shown, columnCount() - 1));
    }
}

void EventFilter::rebuild() {
    beginResetModel();
    shown_.clear();
    counts_ = {};
    counted_.assign(static_cast<std::size_t>(events_.rowCount()), 0);
    for (int row = 0; row < events_.rowCount(); ++row) {
        count(row);
        if (accepts(events_.at(row))) {
            shown_.push_back(events_.first() + static_cast<std::uint64_t>(row));
        }
    }
    endResetModel();
    Q_EMIT changed();
}

void EventFilter::search(const QString& text) {
    events_.search(EventQuery{text});
    rebuild();
}

void EventFilter::showSeverity(Severity severity, bool shown) {
    shown ? (void)hidden_.erase(severity) : (void)hidden_.insert(severity);
    rebuild();
}

void EventFilter::showKind(const std::string& kind, bool shown) {
    shown ? (void)hiddenKinds_.erase(kind) : (void)hiddenKinds_.insert(kind);
    rebuild();
}

void EventFilter::showRoutine(bool shown) {
    showsRoutine_ = shown;
    rebuild();
}

QString EventFilter::text() const {
    QStringList without;
    for (const Severity each : severities) {
        if (!shows(each)) without << QString::fromLatin1(name(each));
    }
    for (const std::string& each : hiddenKinds_) without << plainText(each);
    const QString& typed = events_.query().text();
    if (without.isEmpty()) return typed;
    const QString rest = tr("without %1").arg(without.join(QStringLiteral(", ")));
    return typed.isEmpty() ? rest : typed + QStringLiteral(", ") + rest;
}

void EventFilter::count(int row) {
    const EventRow& each = events_.at(row);
    std::uint64_t& before = counted_[static_cast<std::size_t>(row)];
    const std::uint64_t now = each.matches && !each.isGap() ? each.times : 0;
    add(each, now - before);
    before = now;
}

// Of what has gone, a number below zero: it is one modulo 2^64.
void EventFilter::add(const EventRow& row, std::uint64_t events) {
    counts_.kinds.resize(events_.kinds().size());
    counts_.severities[static_cast<std::size_t>(row.event.severity)] += events;
    counts_.kinds[row.kind] += events;
    if (row.isRoutine()) counts_.routine += events;
    if (accepts(row)) counts_.shown += events;
}

int EventFilter::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : static_cast<int>(shown_.size());
}

int EventFilter::columnCount(const QModelIndex& /*parent*/) const {
    return EventModel::ColumnCount;
}

QVariant EventFilter::data(const QModelIndex& index, int role) const {
    if (!index.isValid()) return {};
    return events_.data(events_.index(sourceOf(index.row()), index.column()), role);
}

QVariant EventFilter::headerData(int section, Qt::Orientation orientation, int role) const {
    return events_.headerData(section, orientation, role);
}

}  // namespace cortex::explorer
