// SPDX-License-Identifier: Apache-2.0
#include "model/event_filter.hpp"

#include "model/plain_text.hpp"

#include <algorithm>
#include <utility>

namespace cortex::gui {

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
    connect(&events, &QAbstractItemModel::modelReset, this, &EventFilter::rebuild);
}

std::optional<std::size_t> EventFilter::placeOf(std::uint64_t serial) const {
    const auto found = std::ranges::lower_bound(shown_, serial);
    if (found == shown_.end() || *found != serial) return std::nullopt;
    return static_cast<std::size_t>(found - shown_.begin());
}

std::optional<int> EventFilter::rowOf(std::uint64_t serial) const {
    const auto place = placeOf(serial);
    if (!place) return std::nullopt;
    return static_cast<int>(*place) + (opened_ && serial > *opened_ ? members_ : 0);
}

EventFilter::Entry EventFilter::entry(int row) const {
    const auto opened = opened_ ? placeOf(*opened_) : std::nullopt;
    const auto place = static_cast<std::size_t>(row);
    if (!opened || place <= *opened) return {shown_[place], std::nullopt};
    const auto members = static_cast<std::size_t>(members_);
    if (place <= *opened + members) return {*opened_, place - *opened - 1};
    return {shown_[place - members], std::nullopt};
}

void EventFilter::open(std::uint64_t serial) {
    if (isOpen(serial)) return;
    close();
    const auto row = rowOf(serial);
    if (!row || rowAt(serial).times < 2) return;
    const int members = static_cast<int>(rowAt(serial).others.size()) + 1;
    beginInsertRows({}, *row + 1, *row + members);
    opened_ = serial;
    members_ = members;
    endInsertRows();
}

void EventFilter::close() {
    if (!opened_) return;
    const int row = *rowOf(*opened_);
    beginRemoveRows({}, row + 1, row + members_);
    opened_.reset();
    members_ = 0;
    endRemoveRows();
}

// The row that is open has more events, or others.
void EventFilter::grow() {
    const int row = *rowOf(*opened_);
    const int members = static_cast<int>(rowAt(*opened_).others.size()) + 1;
    if (members > members_) {
        beginInsertRows({}, row + 1 + members_, row + members);
        members_ = members;
        endInsertRows();
    }
    Q_EMIT dataChanged(index(row + 1, 0), index(row + members_, columnCount() - 1));
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
    if (opened_ && *opened_ < left) close();
    const auto end = std::ranges::lower_bound(shown_, left);
    if (end == shown_.begin()) return;
    beginRemoveRows({}, 0, static_cast<int>(end - shown_.begin()) - 1);
    shown_.erase(shown_.begin(), end);
    endRemoveRows();
}

void EventFilter::tell(int first, int last) {
    for (int row = first; row <= last; ++row) {
        count(row);
        const std::uint64_t serial = events_.first() + static_cast<std::uint64_t>(row);
        const auto shown = rowOf(serial);
        if (shown && isOpen(serial)) grow();
        if (shown) Q_EMIT dataChanged(index(*shown, 0), index(*shown, columnCount() - 1));
    }
}

void EventFilter::rebuild() {
    beginResetModel();
    if (opened_) opened_ = events_.renumbered(*opened_);
    shown_.clear();
    counts_ = {};
    counted_.assign(static_cast<std::size_t>(events_.rowCount()), 0);
    for (int row = 0; row < events_.rowCount(); ++row) {
        count(row);
        if (accepts(events_.at(row))) {
            shown_.push_back(events_.first() + static_cast<std::uint64_t>(row));
        }
    }
    if (opened_ && !placeOf(*opened_)) {
        opened_.reset();
        members_ = 0;
    }
    endResetModel();
    Q_EMIT changed();
}

void EventFilter::search(const QString& text) {
    const EventQuery query{text};
    const bool names = query.namesJogs();
    if (names && !showsRoutine_) {
        showsRoutine_ = namesRoutine_ = true;
    } else if (!names && std::exchange(namesRoutine_, false)) {
        showsRoutine_ = false;
    }
    events_.search(query);
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
    if (shown == showsRoutine_) return;
    namesRoutine_ = false;
    showsRoutine_ = shown;
    rebuild();
}

void EventFilter::showAll() {
    hidden_.clear();
    hiddenKinds_.clear();
    showsRoutine_ = false;
    search({});
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
    const std::uint64_t now = each.isGap() ? 0 : each.times;
    add(each, now - before);
    before = now;
}

// Of what has gone, a number below zero: it is one modulo 2^64.
void EventFilter::add(const EventRow& row, std::uint64_t events) {
    counts_.kinds.resize(events_.kinds().size());
    const bool accepted = accepts(row);
    if (!accepted && row.event.severity == Severity::Error) counts_.hiddenErrors += events;
    if (!row.matches) return;
    counts_.severities[static_cast<std::size_t>(row.event.severity)] += events;
    counts_.kinds[row.kind] += events;
    if (row.isRoutine()) counts_.routine += events;
    if (accepted) counts_.shown += events;
}

int EventFilter::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : static_cast<int>(shown_.size()) + members_;
}

int EventFilter::columnCount(const QModelIndex& /*parent*/) const {
    return EventModel::ColumnCount;
}

QVariant EventFilter::data(const QModelIndex& index, int role) const {
    if (!index.isValid()) return {};
    const auto [serial, member] = entry(index.row());
    const EventRow& row = rowAt(serial);
    const int column = index.column();
    const bool own = role == Qt::ToolTipRole || column == EventModel::Time ||
                     column == EventModel::Text || column == EventModel::Times;
    if (!member || !own) {
        return events_.data(events_.index(static_cast<int>(serial - events_.first()), column),
                            role);
    }
    const comms::AgentEvent& event = *member == 0 ? row.event : row.others[*member - 1];
    if (role == Qt::ToolTipRole) return tipText(plainText(saidText(event)));
    if (role != Qt::DisplayRole && role != Qt::AccessibleTextRole) return {};
    if (column == EventModel::Times) return {};
    if (column == EventModel::Time) return EventModel::timeText(event.wallClock);
    return QStringLiteral("    ") + plainText(saidText(event));
}

QVariant EventFilter::headerData(int section, Qt::Orientation orientation, int role) const {
    return events_.headerData(section, orientation, role);
}

}  // namespace cortex::gui
