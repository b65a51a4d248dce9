// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/printable.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::cli {

std::size_t textWidth(std::string_view text);  // characters of UTF-8
std::string clipped(const std::string& text, std::size_t width);

// Lines of whole words, none longer than `width` unless a word is.
std::vector<std::string> wrapped(const std::string& text, std::size_t width);

std::string plural(std::size_t count, const std::string& thing);  // "1 error", "3 errors"
std::string joined(const std::vector<std::string>& parts, std::string_view separator = ", ");

}  // namespace cortex::cli
