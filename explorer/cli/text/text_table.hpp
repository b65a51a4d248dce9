// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cortex::cli {

// How text looks on a terminal; plain where there are no colours.
enum class Look : std::uint8_t { Plain, Strong, Faint, Good, Warning, Error };

struct Span {
    std::string text;
    Look look = Look::Plain;
};
using TextLine = std::vector<Span>;

inline constexpr std::size_t anyWidth = static_cast<std::size_t>(-1);

// Control characters are made visible; what is beyond `width` characters is cut off.
std::string rendered(const TextLine& line, std::size_t width, bool coloured);

struct TableColumn {
    std::string group;  // stands above neighbours with the same
    std::string heading;
    int importance = 0;     // columns of the least are left out first where there is no room
    std::size_t width = 0;  // at least, so that it does not jump
    bool right = true;      // aligned to the right
    bool wraps = false;     // into lines where there is no room; of one column at most
};

// Cells in aligned columns, as many as fit.
class TextTable {
public:
    explicit TextTable(std::vector<TableColumn> columns) : columns_{std::move(columns)} {}

    void add(TextLine cells) { rows_.push_back(std::move(cells)); }
    std::vector<TextLine> lines(std::size_t width) const;  // headings first

private:
    // The columns that are shown; narrows the one that is wrapped.
    std::vector<std::size_t> fitting(std::vector<std::size_t>& widths, std::size_t width) const;
    // A row as the lines of cells that it takes.
    std::vector<TextLine> split(const TextLine& row, const std::vector<std::size_t>& widths) const;
    TextLine groups(const std::vector<std::size_t>& shown,
                    const std::vector<std::size_t>& widths) const;

    std::vector<TableColumn> columns_;
    std::vector<TextLine> rows_;
};

}  // namespace cortex::cli
