// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "live/top_data.hpp"
#include "text/text_table.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace cortex::cli {

// What a frame looks like within `rows` lines of `width` characters; `head` stands above it.
std::vector<TextLine> topLines(const TopFrame& frame, const std::string& head, std::size_t width,
                               std::size_t rows);

}  // namespace cortex::cli
