// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/explorer/view.hpp"

namespace cortex::explorer {

// The views of drives and of their links, which the window has from the start.
const Plugin& driveViews();

}  // namespace cortex::explorer
