// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace cortex {

// Text from files, arguments and other agents may hold anything: control characters, which a
// terminal would obey, and octets that are no UTF-8 become visible escapes.
std::string printable(std::string_view text);

}  // namespace cortex
