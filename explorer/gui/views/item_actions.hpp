// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/network_options.hpp"

namespace cortex::gui {

class ItemModel;
class ItemTable;

// The menu of a value, and its keys: plot it; copy it, its path, or the command line that shows or
// sets it; set it; the units of all.
void addItemActions(ItemTable& table, ItemModel& items, const comms::NetworkOptions& network);

}  // namespace cortex::gui
