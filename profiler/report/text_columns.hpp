// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace cortex::profiler {

struct TextColumn {
    std::string heading;
    int importance = 0;  // the least are left out first where there is no room
    bool right = true;   // aligned to the right
};

// A table of plain text, headings first. The first column is wrapped where there is no room for it,
// all the others are left whole. Control characters become visible.
std::string textColumns(const std::vector<TextColumn>& columns,
                        const std::vector<std::vector<std::string>>& rows, std::size_t width);

// Text from files may hold anything: control characters, which a terminal would obey, become '?'.
std::string printable(std::string text);

// Lines of whole words, none longer than `width` unless a word is.
std::vector<std::string> wrappedText(const std::string& text, std::size_t width);

}  // namespace cortex::profiler
