// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include <QAbstractTableModel>
#include <deque>
#include <vector>

namespace cortex::explorer {

// The events of all agents, the newest last; the same event again counts up in its row.
class EventModel : public QAbstractTableModel {
    Q_OBJECT
public:
    enum Column { Time, SeverityColumn, Path, Agent, Text, ColumnCount };
    static constexpr std::size_t kept = 100'000;

    using QAbstractTableModel::QAbstractTableModel;

    void add(std::vector<comms::AgentEvent> events);
    Severity severity(int row) const { return rows_[static_cast<std::size_t>(row)].event.severity; }
    std::uint64_t count() const { return count_; }  // of all that came

    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

private:
    struct Row {
        comms::AgentEvent event;
        int times = 1;
    };
    std::deque<Row> rows_;
    std::uint64_t count_ = 0;
};

}  // namespace cortex::explorer
