// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "record/recorded_item.hpp"
#include "session/frame.hpp"

#include <QModelIndex>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::gui {

class ItemModel;

// What a row of values is in a plot: its item, the elements of its array, or all items of its group
// that are not constant.
std::vector<RecordedItem> plottedItems(const ItemModel& items, const QModelIndex& row);

// What a simplex is in a plot: its numbers that are not constant, without those of the framework
// where it has others.
std::vector<RecordedItem> plottedItems(const Frame& frame, const std::string& path);
// One item of it, with all its elements; none where it is a text or is not there.
std::vector<RecordedItem> plottedItems(const Frame& frame, const std::string& path,
                                       std::string_view item);

}  // namespace cortex::gui
