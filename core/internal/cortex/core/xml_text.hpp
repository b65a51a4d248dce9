// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace cortex {

// A text as it stands between the quotation marks of an XML attribute.
std::string xmlAttribute(std::string_view text);

}  // namespace cortex
