// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/network_options.hpp"

namespace cortex::explorer {

class ItemModel;
class ItemTable;

// The menu of a value, and its keys: copy it, its path, or the command line that shows or sets it;
// set it.
void addItemActions(ItemTable& table, const ItemModel& items, const comms::NetworkOptions& network);

}  // namespace cortex::explorer
