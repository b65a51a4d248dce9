// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/results.hpp"

#include <optional>
#include <string>
#include <vector>

namespace cortex::profiler {

// The value in baselines; nothing where there is no baseline or no sense in it.
std::optional<double> ratioToBaseline(const Quantity& quantity);

// NotJudged: the run was too noisy to tell, which is neither met nor missed.
enum class Verdict { Met, Missed, NotJudged };
// Nothing where there is no aim; what is not a number misses any.
std::optional<Verdict> verdictOf(const Quantity& quantity);

struct Aims {
    std::size_t all = 0;
    std::vector<std::string> missed;     // "what was measured: 3 ticks (aim ≤ 1 ticks)"
    std::vector<std::string> notJudged;  // with the reason in place of the aim
};
Aims aimsOf(const Results& results);
// 1: not complete, 4: an aim was missed, 0: neither.
int exitCodeOf(const Results& results);

// The cells of a summary table; empty where there is nothing to say.
std::string valueText(const Quantity& quantity);
std::string baselineText(const Quantity& quantity);
std::string ratioText(const Quantity& quantity);
std::string aimText(const Quantity& quantity);      // "≤ 1.2"
std::string verdictText(const Quantity& quantity);  // "met", "MISSED", "not judged"

}  // namespace cortex::profiler
