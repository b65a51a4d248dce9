// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/item_model.hpp"

#include <QString>
#include <array>
#include <utility>

// How wide the columns of a table of data are, in units.
namespace cortex::gui {

using ItemWidths = std::array<double, ItemModel::ColumnCount>;

// What texts need beyond these they get, up to a limit.
inline constexpr ItemWidths usualItemWidths{52, 28, 16, 52, 32, 40};
inline constexpr double leastTrack = 20;  // of the bar of a range

// The widest texts of all rows, in pixels.
struct ItemTexts {
    int name = 0, value = 0, unit = 0, limit = 0, remark = 0, mark = 0;
};
ItemTexts widestTexts(const ItemModel& items);
int longestValue(const ItemModel& items);  // in letters, where its length is limited

// With this room, and rows that are indented so far; units. What does not fit has its width all
// the same: it is not shown.
ItemWidths itemWidths(const ItemTexts& widest, double room, double indent);

// As the column of ranges shows them.
std::pair<QString, QString> limitsOf(const ItemModel::Row& row);

}  // namespace cortex::gui
