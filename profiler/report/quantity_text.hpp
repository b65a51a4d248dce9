// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/results.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::profiler {

// The value in baselines; nothing where there is no baseline or no sense in it.
std::optional<double> ratioToBaseline(const Quantity& quantity);

// Nothing where there is no aim; what is not a number meets none.
std::optional<bool> met(const Quantity& quantity);

struct Aims {
    std::size_t all = 0;
    std::vector<std::string> missed;  // "what was measured: 3 ticks (aim ≤ 1 ticks)"
};
Aims aimsOf(const Results& results);

// The cells of a summary table; empty where there is nothing to say.
std::string valueText(const Quantity& quantity, std::string_view group = " ");
std::string baselineText(const Quantity& quantity, std::string_view group = " ");
std::string ratioText(const Quantity& quantity);
std::string aimText(const Quantity& quantity, std::string_view group = " ");  // "≤ 1.2"

}  // namespace cortex::profiler
