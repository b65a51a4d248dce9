// SPDX-License-Identifier: Apache-2.0
// In place of the report library until it is here: the same names, text files instead.
#pragma once

#include "cortex/core/error.hpp"

#include "report/results.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace cortex::profiler {

inline std::string summaryText(const Results& results, std::size_t) {
    std::ostringstream text;
    for (const Quantity& each : results.quantities) {
        text << each.id << " = " << each.value << ' ' << each.unit;
        if (each.baseline) text << " (" << each.baselineName << ": " << *each.baseline << ')';
        if (each.aim != Aim::None) {
            const bool met =
                each.aim == Aim::AtMost ? each.value <= each.limit : each.value >= each.limit;
            text << (met ? " met " : " NOT met ") << each.limit;
        }
        text << '\n';
    }
    for (const std::string& note : results.notes) text << "note: " << note << '\n';
    return text.str();
}

inline void save(const Results& results, const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    std::ofstream{folder / "results.json"} << summaryText(results, 100) << results.complete << '\n';
    for (const Figure& figure : results.figures) {
        std::ofstream file{folder / (figure.id + ".csv")};
        for (const Series& series : figure.series) {
            for (const Point& point : series.points) {
                file << series.name << ';' << point.x << ';' << point.y << '\n';
            }
        }
    }
}

inline Results load(const std::filesystem::path& folder) {
    if (!std::filesystem::exists(folder / "results.json")) {
        throw Error(folder.string() + " has no results.json");
    }
    return {};
}

enum class Verdict { Worse, Better, Noise, NotComparable };
struct Compared {
    Verdict verdict = Verdict::Noise;
};
struct Comparison {
    std::vector<Compared> quantities;
};
inline Comparison compare(const Results&, const Results&) { return {}; }
inline std::string comparisonText(const Comparison&, std::size_t) { return "no comparison yet\n"; }
inline std::vector<std::pair<std::string, std::string>> machineFacts() { return {}; }

}  // namespace cortex::profiler
