// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace cortex::common {

// A text as one cell of comma-separated values (RFC 4180): its own bytes, in quotes where it has a
// comma, a quote, a blank or a control character.
std::string csvCell(std::string_view text);

}  // namespace cortex::common
