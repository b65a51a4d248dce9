// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace cortex::common {

// What an event of this kind tells, in one sentence; "" of a kind that is not known here.
std::string_view kindMeaning(std::string_view kind);

}  // namespace cortex::common
