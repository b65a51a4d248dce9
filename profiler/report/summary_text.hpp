// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/results.hpp"

#include <cstddef>
#include <string>

namespace cortex::cli {
class TextTable;
}

namespace cortex::profiler {

// The summary table of the report for a terminal: plain, aligned, under headings, with a verdict
// where there is an aim; then how many are met, those that are not, and the notes.
std::string summaryText(const Results& results, std::size_t width);

std::string tableText(const cli::TextTable& table, std::size_t width);

}  // namespace cortex::profiler
