// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/model_files.hpp"
#include "cortex/core/simplex_tree.hpp"

#include "text/output.hpp"

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace cortex::cli {

using Paths = std::vector<std::filesystem::path>;

// Files as an agent would read them: types, and the simplexes of their system with what the rules
// create and the agent's own. `report` has everything found.
struct Model {
    Report report;
    Paths files;  // all that were read
    bool hasSystem = false;
    std::unique_ptr<SimplexTree> tree;  // without a system it holds the types only

    const TypeModel& types() const { return tree->types(); }
};

bool isSystem(const std::filesystem::path& file);
Model readTypes(std::span<const std::filesystem::path> files);
Model readSystem(std::span<const std::filesystem::path> files);  // and validates

// A file that was named on the command line cannot be read: not found, rather than wrong.
bool lacksFile(const Report& report);
// What several models share is found several times and said once.
Report joinReports(std::span<const Model* const> models);
// Throws Failure if one of the models has errors; prints warnings.
void requireValid(std::span<const Model* const> models);
void requireValid(const Model& model);

}  // namespace cortex::cli
