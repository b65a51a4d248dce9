// SPDX-License-Identifier: Apache-2.0
#include "report/text_columns.hpp"

#include "report/number_text.hpp"

#include <algorithm>
#include <numeric>

namespace cortex::profiler {
namespace {

constexpr std::size_t gap = 2, leastFirst = 24;  // leastFirst: of the column that is wrapped

using Rows = std::vector<std::vector<std::string>>;

std::string aligned(const std::string& text, std::size_t width, bool right) {
    const std::string blanks(width - std::min(width, characters(text)), ' ');
    return right ? blanks + text : text + blanks;
}

std::vector<std::size_t> widthsOf(const std::vector<TextColumn>& columns, const Rows& rows) {
    std::vector<std::size_t> widths;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        widths.push_back(characters(columns[i].heading));
        for (const auto& row : rows) widths[i] = std::max(widths[i], characters(row.at(i)));
    }
    return widths;
}

// Those that fit; the first is one of them and gets what the others leave.
std::vector<std::size_t> fitting(const std::vector<TextColumn>& columns,
                                 std::vector<std::size_t>& widths, std::size_t width) {
    std::vector<std::size_t> shown(columns.size());
    std::iota(shown.begin(), shown.end(), 0U);
    const auto others = [&] {
        std::size_t sum = 0;
        for (const std::size_t each : shown) sum += each == 0 ? 0 : widths[each] + gap;
        return sum;
    };
    while (shown.size() > 1 && others() + std::min(widths[0], leastFirst) > width) {
        shown.erase(std::min_element(shown.begin() + 1, shown.end(), [&](auto a, auto b) {
            return columns[a].importance < columns[b].importance;
        }));
    }
    const std::size_t left = width - std::min(width, others());
    widths[0] = std::min(widths[0], std::max(left, leastFirst));
    return shown;
}

}  // namespace

std::string printable(std::string text) {
    std::ranges::replace_if(
        text, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }, '?');
    return text;
}

std::vector<std::string> wrappedText(const std::string& text, std::size_t width) {
    std::vector<std::string> lines(1);
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find(' ', begin), text.size());
        const std::string word = text.substr(begin, end - begin);
        if (lines.back().empty()) {
            lines.back() = word;
        } else if (characters(lines.back()) + 1 + characters(word) <= width) {
            lines.back() += " " + word;
        } else {
            lines.push_back(word);
        }
        begin = end + 1;
    }
    return lines;
}

std::string textColumns(const std::vector<TextColumn>& columns, const Rows& rows,
                        std::size_t width) {
    Rows cells{{}};
    for (const TextColumn& each : columns) cells[0].push_back(each.heading);
    for (const auto& row : rows) {
        cells.push_back(row);
        std::ranges::transform(row, cells.back().begin(), printable);
    }
    std::vector<std::size_t> widths = widthsOf(columns, cells);
    const std::vector<std::size_t> shown = fitting(columns, widths, width);
    std::string text;
    for (const auto& row : cells) {
        const std::vector<std::string> firsts = wrappedText(row[0], widths[0]);
        for (std::size_t i = 0; i < firsts.size(); ++i) {
            std::string line = aligned(firsts[i], widths[0], false);
            for (std::size_t n = 1; n < shown.size() && i == 0; ++n) {
                line += std::string(gap, ' ') +
                        aligned(row[shown[n]], widths[shown[n]], columns[shown[n]].right);
            }
            line.erase(line.find_last_not_of(' ') + 1);
            text += line + "\n";
        }
    }
    return text;
}

}  // namespace cortex::profiler
