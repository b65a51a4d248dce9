// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <QString>
#include <array>
#include <optional>
#include <vector>

// What the loop of an agent measures of itself, from the items of its own simplex.
namespace cortex::gui {

// One measured figure: its last value, and since the start of the agent its percentiles and its
// greatest value.
struct LoopFigure {
    enum Which { Last, P50, P99, P999, Max, Count };

    QString title, unit;
    std::array<std::optional<double>, Count> numbers;  // none: not known, which is not 0
    std::array<QString, Count> texts;                  // "1000.2", "[1000.2]", "—"
    QString unknown;                                   // why nothing of it is known; or empty
};

struct LoopMetrics {
    enum Time { Cycle, Jitter, Lateness, Command };

    LoopFigure duty;                // in % of the period
    std::vector<LoopFigure> times;  // by Time, all in µs
    bool live = false;              // otherwise the numbers are the last ones, in brackets
};

LoopMetrics loopMetrics(const AgentFrame& agent);

// "1 thread, pinned to CPU 3"; empty: not known.
QString threadText(const AgentFrame& agent);

// A logarithmic axis of whole decades of µs around all numbers above 0.
struct LogAxis {
    int from = 0, to = 2;  // powers of ten
    bool below = false;    // something lies before its beginning

    static LogAxis around(const std::vector<LoopFigure>& figures);
    LogAxis joined(const LogAxis& other) const;
    bool operator==(const LogAxis&) const = default;
    // Where a power of ten, or a number, lies between 0 and 1; what is below the axis, such as the
    // number 0, lies at 0.
    double share(int power) const { return static_cast<double>(power - from) / (to - from); }
    double shareOf(double number) const;
    QString label(int power) const;  // "10 µs", "≤ 1 µs" where something is below
};

}  // namespace cortex::gui
