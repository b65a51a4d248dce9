// SPDX-License-Identifier: Apache-2.0
#include "model/event_model.hpp"

#include "model/plain_text.hpp"

#include <QDateTime>
#include <QTimeZone>
#include <algorithm>
#include <tuple>

namespace cortex::explorer {

namespace {

bool sameBut(const comms::AgentEvent& a, const comms::AgentEvent& b) {
    return a.text == b.text && a.path == b.path && a.kind == b.kind && a.agent == b.agent &&
           a.severity == b.severity;
}

QString timeText(std::int64_t wallClock) {
    return QDateTime::fromMSecsSinceEpoch(wallClock / 1'000'000, QTimeZone::utc())
        .toString(QStringLiteral("HH:mm:ss.zzz"));
}

// What comes from outside is text: no line breaks, no control characters.
QString plain(const std::string& text) {
    QString result = QString::fromStdString(text);
    for (QChar& c : result) {
        if (!c.isPrint()) c = ' ';
    }
    return result;
}

}  // namespace

void EventModel::add(std::vector<comms::AgentEvent> events) {
    if (events.empty()) return;
    count_ += events.size();
    std::ranges::sort(events, {}, [](const comms::AgentEvent& each) {
        return std::tie(each.wallClock, each.agent, each.number);
    });
    std::vector<Row> fresh;
    for (comms::AgentEvent& event : events) {
        Row* last = !fresh.empty() ? &fresh.back() : !rows_.empty() ? &rows_.back() : nullptr;
        if (last != nullptr && sameBut(last->event, event)) {
            ++last->times;
            last->event.wallClock = event.wallClock;
        } else {
            fresh.push_back({std::move(event), 1});
        }
    }
    if (!rows_.empty()) {
        const auto last = static_cast<int>(rows_.size()) - 1;
        Q_EMIT dataChanged(index(last, 0), index(last, ColumnCount - 1));
    }
    if (fresh.empty()) return;
    const auto first = static_cast<int>(rows_.size());
    beginInsertRows({}, first, first + static_cast<int>(fresh.size()) - 1);
    rows_.insert(rows_.end(), std::make_move_iterator(fresh.begin()),
                 std::make_move_iterator(fresh.end()));
    endInsertRows();
    if (rows_.size() <= kept) return;
    const auto gone = static_cast<int>(rows_.size() - kept);
    beginRemoveRows({}, 0, gone - 1);
    rows_.erase(rows_.begin(), rows_.begin() + gone);
    endRemoveRows();
}

int EventModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : static_cast<int>(rows_.size());
}

int EventModel::columnCount(const QModelIndex& /*parent*/) const { return ColumnCount; }

QVariant EventModel::data(const QModelIndex& index, int role) const {
    const bool texts = role == Qt::DisplayRole || role == Qt::AccessibleTextRole;
    if (!index.isValid() || (!texts && role != Qt::ToolTipRole)) return {};
    const Row& row = rows_[static_cast<std::size_t>(index.row())];
    const comms::AgentEvent& event = row.event;
    const QString times = row.times > 1 ? QStringLiteral("×%1  ").arg(row.times) : QString{};
    if (role == Qt::ToolTipRole) return tipText(plain(event.text));
    switch (index.column()) {
        case Time:
            return timeText(event.wallClock);
        case SeverityColumn:
            return QLatin1String{name(event.severity)};
        case Path:
            return plain(event.path);
        case Text:
            return times + plain(event.text);
        default:
            return plain(event.agent);
    }
}

QVariant EventModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal || role != Qt::DisplayRole) return {};
    switch (section) {
        case Time:
            return tr("Time (UTC)");
        case SeverityColumn:
            return tr("Severity");
        case Path:
            return tr("Simplex");
        case Text:
            return tr("Text");
        default:
            return tr("Agent");
    }
}

}  // namespace cortex::explorer
