// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace cortex::profiler {

inline constexpr double none = std::numeric_limits<double>::quiet_NaN();

struct Axis {
    std::string label, unit;
    bool logarithmic = false;
};

struct Point {
    double x = 0, y = 0;
};

// One line of a plot. Baselines are drawn apart from what is measured of CorteX. Series whose names
// begin alike up to a comma belong together: "same cycle, p50" and "same cycle, p99".
struct Series {
    std::string name;  // of the legend: "p99", "bare sleeper"
    std::vector<Point> points;
    bool baseline = false;
};

// A straight line across a plot: what the paper states, a limit, the overflow point.
struct Mark {
    enum class Along { X, Y };
    Along along = Along::Y;  // Y: horizontal, at that y
    double at = 0;
    std::string text;
};

// One plot of the report and one CSV file.
struct Figure {
    std::string id;     // file name without extension, ordered: "fig23-duty-cycle"
    std::string title;  // begins with the number of the paper's figure, where it has one
    std::string paper;  // what the paper shows and states
    std::string setup;  // what was run to get it
    Axis x, y;
    std::vector<Series> series;
    std::vector<Mark> marks;
};

enum class Aim { None, AtMost, AtLeast };

// One figure of the summary table, and what `compare` compares.
struct Quantity {
    std::string id;  // the same in every run: "scheduler/independent/1024/1"
    std::string what;
    std::string unit;
    double value = 0;
    std::vector<double> repeats{};  // of which `value` is the median or the best; the noise of it
    double baseline = none;
    std::string baselineName{};
    Aim aim = Aim::None;
    double limit = 0;
    std::string paper{};  // what the paper has for it
    bool lessIsBetter = true;
    std::string doubt{};  // why this run cannot judge the aim; empty: it is judged
    std::string group{};  // heading in the summary

    Quantity& ofRepeats(std::vector<double> all);
    Quantity& beside(double other, std::string name);
    Quantity& atMost(double aimed);
    Quantity& atLeast(double aimed);  // and more is better
    Quantity& moreIsBetter();
    Quantity& inPaper(std::string text);
};

// What one run of the profiler found, whole or up to where it was stopped.
struct Results {
    std::string started;                                       // UTC
    std::string command;                                       // as typed
    std::string version;                                       // of CorteX
    std::vector<std::pair<std::string, std::string>> machine;  // fact, value
    std::vector<std::string> notes;                            // refusals, what was left out
    std::vector<Quantity> quantities;
    std::vector<Figure> figures;
    bool complete = false;  // all that was asked for was measured

    Quantity& add(std::string id, std::string what, std::string unit, double value);
};

}  // namespace cortex::profiler
