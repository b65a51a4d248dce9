// SPDX-License-Identifier: Apache-2.0
#include "model/last_events.hpp"

#include <algorithm>
#include <utility>

namespace cortex::gui {

LastEvents::LastEvents(const EventModel& events, QObject* parent)
    : QObject{parent}, events_{events} {
    connect(&events, &QAbstractItemModel::rowsInserted, this,
            [this](const QModelIndex&, int first, int last) { add(first, last); });
    connect(&events, &QAbstractItemModel::dataChanged, this,
            [this](const QModelIndex& first, const QModelIndex& last) {
                change(first.row(), last.row());
            });
    connect(&events, &QAbstractItemModel::modelReset, this, [this] { other_ = true; });
}

void LastEvents::add(int first, int last) {
    const std::size_t before = rows_.size();
    for (int row = last; row >= first && rows_.size() - before < most; --row) {
        if (auto found = lastRow(events_.at(row))) rows_.push_back(std::move(*found));
    }
    std::reverse(rows_.begin() + static_cast<std::ptrdiff_t>(before), rows_.end());
}

// A refusal that comes again counts up in its row.
void LastEvents::change(int first, int last) {
    for (int row = first; row <= last; ++row) {
        auto changed = lastRow(events_.at(row));
        if (!changed) continue;
        const auto found = std::ranges::find(rows_, changed->key, &OverviewRow::key);
        if (found != rows_.end()) *found = std::move(*changed);
    }
}

void LastEvents::fill() {
    rows_.clear();
    std::size_t losses = 0;
    for (int row = events_.rowCount() - 1; row >= 0 && rows_.size() < usual; --row) {
        auto found = lastRow(events_.at(row));
        if (!found || (found->isLoss && ++losses > usualLosses)) continue;
        rows_.push_back(std::move(*found));
    }
    std::ranges::reverse(rows_);
    other_ = false;
}

void LastEvents::keepUsual() {
    for (auto each = rows_.begin(); each != rows_.end(); ++each) {
        const auto place =
            std::ranges::upper_bound(rows_.begin(), each, each->time, {}, &OverviewRow::time);
        std::rotate(place, each, each + 1);
    }
    auto tooMany = std::ranges::count(rows_, true, &OverviewRow::isLoss) -
                   static_cast<std::ptrdiff_t>(usualLosses);
    std::erase_if(rows_, [&](const OverviewRow& each) { return each.isLoss && tooMany-- > 0; });
    if (rows_.size() > usual)
        rows_.erase(rows_.begin(), rows_.end() - static_cast<std::ptrdiff_t>(usual));
}

const OverviewRows& LastEvents::update(bool held) {
    if (other_ && (!held || rows_.empty())) fill();
    if (!held) {
        keepUsual();
    } else if (rows_.size() > most) {
        rows_.erase(rows_.begin(), rows_.end() - static_cast<std::ptrdiff_t>(most));
    }
    return rows_;
}

}  // namespace cortex::gui
