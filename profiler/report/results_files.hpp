// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/results.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace cortex::profiler {

// Writes results.json, summary.csv, a CSV file and a picture of each figure, and report.html; makes
// the folder. Each file but a picture is either the one before or the new one, whenever the program
// is killed: may be called after each measurement. Throws cortex::Error.
void save(const Results& results, const std::filesystem::path& folder);

// What `save` wrote, from results.json alone. Throws cortex::Error that names the file, what is
// wrong with it and what to do.
Results load(const std::filesystem::path& folder);

// The names of the figures' CSV files without extension, in their order: the ids, without what
// file names should not have, no two the same.
std::vector<std::string> figureFiles(const Results& results);

std::string figureCsv(const Figure& figure);
std::string summaryCsv(const Results& results);

}  // namespace cortex::profiler
