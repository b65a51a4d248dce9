// SPDX-License-Identifier: Apache-2.0
#include "ds402/drive_words.hpp"

#include "cortex/drives/ds402_state.hpp"
#include "cortex/drives/ds402_words.hpp"

#include <array>
#include <string_view>

namespace cortex::toolkit {
namespace {

void addHex(EventText& text, std::int64_t code) {
    constexpr std::string_view digits = "0123456789ABCDEF";
    std::array<char, 6> word{'0', 'x'};
    for (std::size_t i = 0; i < 4; ++i)
        word[2 + i] = digits[static_cast<std::size_t>(code >> (12 - 4 * i) & 0xF)];
    text << std::string_view{word.data(), word.size()};
}

}  // namespace

EventText errorWords(std::int64_t code) {
    EventText text;
    if (code == 0) return text << "no error";
    std::string_view name;
    for (const drives::Ds402ErrorRow& row : drives::ds402Errors)
        if (row.code == code) name = row.name;
    if (name.empty() && code >= 0xFF00) name = "error of the maker";
    if (name.empty())
        text << "error ";
    else
        text << name << " (";
    addHex(text, code);
    return name.empty() ? text : text << ")";
}

EventText modeWords(std::int64_t mode) {
    EventText text;
    if (mode == 0) return text << "none";
    const drives::Ds402ModeRow* row = drives::modeRow(static_cast<int>(mode));
    return row != nullptr ? text << row->letters : text << "mode " << mode;
}

int transitionBetween(int from, int to) {
    int last = 0;
    for (const drives::Ds402Transition& row : drives::ds402Transitions) {
        if (static_cast<int>(row.to) != to) continue;
        if (static_cast<int>(row.from) == from) return row.number;
        if (last == 0) last = row.number;
    }
    return last;
}

}  // namespace cortex::toolkit
