// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace cortex {

// Parts between blanks (space, tab, newline); none is empty.
std::vector<std::string_view> splitBlanks(std::string_view text);

// In single quotes and, where hostile input made it long, cut.
std::string inQuotes(std::string_view text);

// [A-Za-z_][A-Za-z0-9_-]*, at most 64 characters: types, items, commands, rules, parameters.
bool isName(std::string_view text);

// "expected 1 value, found 2"
std::string wrongCount(std::size_t expected, std::size_t found);

bool isUtf8(std::string_view text);

}  // namespace cortex
