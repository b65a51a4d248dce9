// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plots/drawn_line.hpp"

#include <QString>
#include <vector>

namespace cortex::gui {

// A stretch of a lane in which one word holds.
struct LaneWord {
    double from = 0, to = 0;  // s, UTC
    QString text;             // empty: it changes too often to be told apart
    bool missing = false;
    double number = 0;
    Lack lack = Lack::NoData;  // of what is missing
};

// What a line of words says in a stretch of time, at so many seconds a pixel.
std::vector<LaneWord> laneWords(const DrawnLine& line, const Recorder& recorder, TimeSpan span,
                                double pixel);

// A number of a lane as its word.
QString wordOf(const PlotLine& line, const Recorder& recorder, double number);

// How dark a number of a lane is, from 0 to 1, always the same: false light, true dark; labels in
// their order.
double shadeOf(const PlotLine& line, double number);

}  // namespace cortex::gui
