// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace cortex {

// A text as it stands between the quotation marks of an XML attribute.
std::string xmlAttribute(std::string_view text);

// <set data="…" value="…"/>. XML cannot have control characters, nor anything that is no UTF-8: a
// value with such octets has them as \xNN, \ as \\, and escaped="true" beside it.
std::string setElement(std::string_view item, std::string_view value);

// A value that was escaped; empty if a \ stands for nothing.
std::optional<std::string> withoutEscapes(std::string_view value);

}  // namespace cortex
