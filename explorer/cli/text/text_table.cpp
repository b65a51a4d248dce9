// SPDX-License-Identifier: Apache-2.0
#include "text/text_table.hpp"

#include "text/plain_text.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace cortex::cli {
namespace {

constexpr std::size_t gap = 2;            // between columns
constexpr std::size_t leastWrapped = 24;  // characters of a column that is wrapped

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

std::vector<std::size_t> TextTable::fitting(std::vector<std::size_t>& widths,
                                            std::size_t width) const {
    std::vector<std::size_t> shown(columns_.size());
    std::iota(shown.begin(), shown.end(), 0U);
    const auto others = [&] {  // and the least of what is wrapped
        std::size_t sum = gap * (shown.size() - 1);
        for (const std::size_t each : shown) sum += columns_[each].wraps ? 0 : widths[each];
        return sum;
    };
    const auto wrapping = std::ranges::find_if(columns_, &TableColumn::wraps);
    const std::size_t place = static_cast<std::size_t>(wrapping - columns_.begin());
    const std::size_t least =
        wrapping == columns_.end() ? 0 : std::min(widths[place], leastWrapped);
    while (shown.size() > 1 && others() + least > width) {
        shown.erase(std::ranges::min_element(
            shown, {}, [&](std::size_t each) { return columns_[each].importance; }));
    }
    if (wrapping != columns_.end() && width != anyWidth) {
        const std::size_t left = width - std::min(width, others());
        widths[place] = std::min(widths[place], std::max(left, leastWrapped));
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

std::vector<TextLine> TextTable::split(const TextLine& row,
                                       const std::vector<std::size_t>& widths) const {
    std::vector<TextLine> lines{row};
    for (std::size_t i = 0; i < row.size(); ++i) {
        if (!columns_[i].wraps) continue;
        const std::vector<std::string> parts = wrapped(printable(row[i].text), widths[i]);
        lines.resize(std::max<std::size_t>(1, parts.size()), TextLine(row.size()));
        for (std::size_t n = 0; n < parts.size(); ++n) lines[n][i] = {parts[n], row[i].look};
    }
    return lines;
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
        for (const TextLine& cells : split(row, widths)) {
            add([&](std::size_t each) { return each < cells.size() ? cells[each] : Span{}; });
        }
    }
    return result;
}

}  // namespace cortex::cli
