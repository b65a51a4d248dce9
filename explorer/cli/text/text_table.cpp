// SPDX-License-Identifier: Apache-2.0
#include "text/text_table.hpp"

#include "text/output.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace cortex::explorer {
namespace {

constexpr std::size_t gap = 2;  // between columns

bool continues(char c) { return (c & 0xC0) == 0x80; }  // a character of UTF-8

std::string clipped(const std::string& text, std::size_t width) {
    std::size_t end = 0;
    for (std::size_t characters = 0; end < text.size(); ++end) {
        if (!continues(text[end]) && characters++ == width) break;
    }
    return text.substr(0, end);
}

std::string aligned(const std::string& text, std::size_t width, bool right) {
    const std::string visible = printable(text);
    const std::string blanks(width - std::min(width, textWidth(visible)), ' ');
    return right ? blanks + visible : visible + blanks;
}

const char* codeOf(Look look) {
    constexpr std::array codes{"", "\033[1m", "\033[2m", "\033[32m", "\033[33m", "\033[1;31m"};
    return codes[static_cast<std::size_t>(look)];
}

}  // namespace

std::string rendered(const TextLine& line, std::size_t width, bool coloured) {
    std::string result;
    std::size_t left = width;
    for (const Span& span : line) {
        const std::string text = clipped(printable(span.text), left);
        left -= textWidth(text);
        const bool styled = coloured && span.look != Look::Plain && !text.empty();
        result += styled ? codeOf(span.look) + text + "\033[0m" : text;
    }
    if (!coloured) result.erase(result.find_last_not_of(' ') + 1);
    return result;
}

std::vector<std::size_t> TextTable::fitting(const std::vector<std::size_t>& widths,
                                            std::size_t width) const {
    std::vector<std::size_t> shown(columns_.size());
    std::iota(shown.begin(), shown.end(), 0U);
    const auto needed = [&] {
        std::size_t sum = gap * (shown.size() - 1);
        for (const std::size_t each : shown) sum += widths[each];
        return sum;
    };
    while (shown.size() > 1 && needed() > width) {
        const auto least = std::ranges::min_element(
            shown, {}, [&](std::size_t each) { return columns_[each].importance; });
        shown.erase(least);
    }
    return shown;
}

// The line above the headings; empty if no column has a group.
TextLine TextTable::groups(const std::vector<std::size_t>& shown,
                           const std::vector<std::size_t>& widths) const {
    std::string text;
    bool any = false;
    for (std::size_t i = 0; i < shown.size();) {
        const std::string& group = columns_[shown[i]].group;
        std::size_t width = 0;
        for (bool first = true; i < shown.size() && columns_[shown[i]].group == group; ++i) {
            width += widths[shown[i]] + (first ? 0 : gap);
            first = false;
        }
        const std::size_t before = (width - std::min(width, textWidth(group))) / 2;
        if (!text.empty()) text.append(gap, ' ');
        text += group.empty() ? std::string(width, ' ')
                              : aligned(std::string(before, '-') + group, width, false);
        if (!group.empty()) {
            const std::size_t blanks = text.size() - (text.find_last_not_of(' ') + 1);
            text.replace(text.size() - blanks, blanks, blanks, '-');
        }
        any = any || !group.empty();
    }
    return any ? TextLine{{text, Look::Faint}} : TextLine{};
}

std::vector<TextLine> TextTable::lines(std::size_t width) const {
    std::vector<std::size_t> widths;
    for (const TableColumn& each : columns_) {
        widths.push_back(std::max(each.width, textWidth(each.heading)));
    }
    for (const TextLine& row : rows_) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            widths[i] = std::max(widths[i], textWidth(printable(row[i].text)));
        }
    }
    const std::vector<std::size_t> shown = fitting(widths, width);
    std::vector<TextLine> result;
    if (TextLine above = groups(shown, widths); !above.empty()) result.push_back(std::move(above));
    const auto add = [&](const auto& cellOf) {
        TextLine line;
        for (const std::size_t each : shown) {
            if (!line.empty()) line.push_back({std::string(gap, ' ')});
            const Span cell = cellOf(each);
            line.push_back({aligned(cell.text, widths[each], columns_[each].right), cell.look});
        }
        result.push_back(std::move(line));
    };
    add([&](std::size_t each) { return Span{columns_[each].heading, Look::Strong}; });
    for (const TextLine& row : rows_) {
        add([&](std::size_t each) { return each < row.size() ? row[each] : Span{}; });
    }
    return result;
}

}  // namespace cortex::explorer
