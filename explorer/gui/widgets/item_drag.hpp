// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "record/recorded_item.hpp"

#include <QMimeData>
#include <vector>

namespace cortex::gui {

// Items on their way from where they are shown to a plot; elsewhere they are text, one a line.
QMimeData* mimeOf(const std::vector<RecordedItem>& items);
std::vector<RecordedItem> itemsIn(const QMimeData* data);  // empty: none

}  // namespace cortex::gui
