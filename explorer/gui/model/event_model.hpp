// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/event_query.hpp"
#include "model/event_row.hpp"

#include <QAbstractTableModel>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

namespace cortex::gui {

// The events of all agents, in the order in which they came; those that came together, by their
// times. The time of a row that came late has an arrow. The same event again counts up in its row;
// where numbers of an agent are missing, a row says how many. What agents kept is put where it
// belongs by its time. Where there are too many the oldest go, chatter first.
class EventModel : public QAbstractTableModel {
    Q_OBJECT
public:
    enum Column { Time, SeverityColumn, Kind, Path, Agent, Text, Times, ColumnCount };

    explicit EventModel(std::size_t kept = 100'000, QObject* parent = nullptr)
        : QAbstractTableModel{parent}, kept_{kept} {}

    void add(std::vector<comms::AgentEvent> events);
    // What agents have kept: each event once, however it came and how often. The model is reset.
    void addPast(std::vector<comms::AgentEvent> events);
    void search(EventQuery query);  // sets EventRow::matches; says nothing
    const EventQuery& query() const { return query_; }

    const EventRow& at(int row) const { return rows_[static_cast<std::size_t>(row)]; }
    std::uint64_t first() const { return first_; }  // serial number of the first row; others follow
    // While the model is reset: the serial number that a row has by now; none: it has gone.
    std::optional<std::uint64_t> renumbered(std::uint64_t serial) const;
    bool renumbers() const { return !places_.empty(); }
    const std::vector<std::string>& kinds() const { return kinds_; }
    std::size_t kept() const { return kept_; }          // events, at most
    std::uint64_t count() const { return count_; }      // of all that came
    std::uint64_t dropped() const { return dropped_; }  // of those, no longer kept

    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
    static QString timeText(std::int64_t utc, bool late = false);  // "↑12:05:07.123"
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

private:
    using Start = std::pair<std::string, std::int64_t>;  // an agent's, by its epoch

    std::vector<EventRow> withGaps(std::vector<comms::AgentEvent> events);
    void place(EventRow row, std::vector<EventRow>& fresh, std::set<std::size_t>& changed);
    void append(std::vector<EventRow> fresh);
    void drop();
    std::vector<EventRow> unknown(std::vector<comms::AgentEvent> events) const;
    void merge(std::vector<EventRow> past);
    std::size_t tooMuchChatter(std::size_t fresh) const;
    void hold(const EventRow& row);
    void release(const EventRow& row);
    std::size_t kindOf(const std::string& kind);

    const std::size_t kept_;
    EventQuery query_;
    std::deque<EventRow> rows_;
    std::uint64_t first_ = std::uint64_t{1} << 40U;   // what is put before others counts down
    std::vector<std::optional<std::size_t>> places_;  // of rows before they were merged
    std::set<std::tuple<std::string, std::int64_t, std::uint64_t>> past_;  // came from memory
    std::unordered_map<std::string, std::uint64_t> open_;  // serial number of the row of a key
    std::map<Start, comms::AgentEvent> last_;              // events without their texts
    std::vector<std::string> kinds_;
    std::uint64_t count_ = 0, dropped_ = 0;
    std::size_t held_ = 0, chatter_ = 0;  // events in all rows
    std::int64_t latest_ = 0;             // time of all rows, UTC ns
};

}  // namespace cortex::gui
