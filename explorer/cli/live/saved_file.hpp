// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/report.hpp"
#include "cortex/core/value.hpp"

#include "text/output.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace cortex::cli {

// What `save` writes and `restore` reads: the settable items of simplexes, as a system file has
// them.
struct SavedItem {
    std::string name;
    std::string value;  // as in XML, before escaping
    std::string note;   // unit and range, for people
    std::string wrong;  // why nobody can set it: then it is a comment; empty: it is good
    Place place;        // where it was read
};
struct SavedSimplex {
    std::string path, type;
    std::vector<SavedItem> items;
    Place place;
};

std::string savedText(const std::vector<SavedSimplex>& simplexes, const std::string& title);
// Throws Failure where there is something of that name, for verbs that replace it by --force alone.
void refuseExisting(const std::string& file);
// Takes the place of the file in one step, or leaves it as it was; throws Failure.
void writeSaved(const std::filesystem::path& file, const std::string& text);
// Throws Failure with everything that is wrong with the file.
std::vector<SavedSimplex> readSaved(const std::filesystem::path& file);

}  // namespace cortex::cli
