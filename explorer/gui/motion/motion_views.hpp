// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/explorer/view.hpp"

namespace cortex::explorer {

// The views of motion that the program has by itself, as a plug-in would offer them.
const Plugin& motionViews();

}  // namespace cortex::explorer
