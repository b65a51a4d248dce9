// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/explorer/theme.hpp"

#include <QRect>
#include <algorithm>

namespace cortex::explorer {

// Where the parts of a row and of its header stand; the bar takes what is left.
struct RowColumns {
    QRect name, bar, value, target, act, drive;
};

inline constexpr double rowUnits = 13.5, buttonWide = 13, buttonHigh = 11, buttonGap = 1.5;
inline constexpr double leastRowUnits = 124, wordUnits = 136;
inline constexpr double leastName = 10, mostName = 22;

// `name`: width of the longest name.
inline RowColumns columnsOf(int width, int height, int name) {
    const int edge = units(4), gap = units(2), number = units(19);
    const bool words = width >= units(wordUnits);  // otherwise a drive is a mark alone
    const int act = units(2 * buttonWide + buttonGap), drive = units(words ? 17 : 4);
    RowColumns columns;
    int right = width - units(2);
    const auto take = [&](int wide) {
        right -= wide;
        const QRect column{right, 0, wide, height};
        right -= gap;
        return column;
    };
    columns.drive = take(drive);
    columns.act = take(act);
    columns.target = take(number);
    columns.value = take(number);
    columns.name = {edge, 0, name, height};
    const int left = edge + name + gap;
    columns.bar = {left, 0, std::max(right - left, 1), height};
    return columns;
}

}  // namespace cortex::explorer
