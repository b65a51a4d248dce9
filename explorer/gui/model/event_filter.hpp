// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/event_model.hpp"

#include <QAbstractTableModel>
#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace cortex::gui {

// The events that are shown: those that match what is typed, without the severities and kinds that
// are switched off. What did not come is always shown. All views of a window share it.
class EventFilter : public QAbstractTableModel {
    Q_OBJECT
public:
    // Events, of those that match what is typed.
    struct Counts {
        std::uint64_t hiddenErrors = 0;  // of all: faults and errors that are not shown
        std::array<std::uint64_t, 3> severities{};
        std::vector<std::uint64_t> kinds;  // as EventModel::kinds()
        std::uint64_t routine = 0, shown = 0;
    };

    explicit EventFilter(EventModel& events, QObject* parent = nullptr);

    EventModel& events() const { return events_; }
    const EventRow& at(int row) const { return rowAt(entry(row).serial); }
    std::uint64_t serial(int row) const { return entry(row).serial; }
    std::optional<int> rowOf(std::uint64_t serial) const;  // none: hidden, or no longer kept
    // Without the events of the row that is open.
    std::size_t rows() const { return shown_.size(); }
    const EventRow& shownAt(std::size_t row) const { return rowAt(shown_[row]); }
    std::uint64_t shownSerial(std::size_t row) const { return shown_[row]; }

    // A row of many events opens to one row for each of them; one is open at a time.
    void open(std::uint64_t serial);
    void close();
    bool isOpen(std::uint64_t serial) const { return opened_ == serial; }
    bool isMember(int row) const { return entry(row).member.has_value(); }

    void search(const QString& text);
    void showSeverity(Severity severity, bool shown);
    void showKind(const std::string& kind, bool shown);
    void showRoutine(bool shown);
    void showAll();  // as at the start: all but jog commands
    bool shows(Severity severity) const { return !hidden_.contains(severity); }
    bool shows(const std::string& kind) const { return !hiddenKinds_.contains(kind); }
    bool showsRoutine() const { return showsRoutine_; }
    QString text() const;  // "in:/arm, without info, limit"; empty: everything is shown
    const Counts& counts() const { return counts_; }

    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

Q_SIGNALS:
    void changed();  // what is asked for

private:
    struct Entry {
        std::uint64_t serial;
        std::optional<std::size_t> member;  // of the row that is open
    };
    Entry entry(int row) const;
    const EventRow& rowAt(std::uint64_t serial) const {
        return events_.at(static_cast<int>(serial - events_.first()));
    }
    std::optional<std::size_t> placeOf(std::uint64_t serial) const;
    void grow();
    bool accepts(const EventRow& row) const;
    void insert(int first, int last);
    void remove(int last);
    void tell(int first, int last);
    void rebuild();
    void add(const EventRow& row, std::uint64_t events);
    void count(int row);  // what it has more than at the last time

    EventModel& events_;
    std::deque<std::uint64_t> shown_;  // serial numbers of rows
    std::optional<std::uint64_t> opened_;
    int members_ = 0;  // rows below the one that is open
    std::set<Severity> hidden_;
    std::set<std::string> hiddenKinds_;
    bool showsRoutine_ = false, namesRoutine_ = false;  // only while the words name it
    Counts counts_;
    std::deque<std::uint64_t> counted_;  // events of each row of the model that are in the counts
};

}  // namespace cortex::gui
