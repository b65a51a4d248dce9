// SPDX-License-Identifier: Apache-2.0
#include "model.hpp"

#include "cortex/core/validation.hpp"

#include <algorithm>

namespace cortex::explorer {
namespace {

namespace fs = std::filesystem;

constexpr const char* fileMissing = "file-missing";

// A folder is the commonest wrong file: said in words, the others are read all the same.
Paths withoutFolders(std::span<const fs::path> files, Report& report) {
    Paths rest;
    for (const fs::path& file : files) {
        std::error_code ignored;
        if (!fs::is_directory(file, ignored)) {
            rest.push_back(file);
            continue;
        }
        report.error("", fileMissing, {file.string(), 0}, "this is a folder",
                     "name the files in it: " + (file / "*.xml").lexically_normal().string());
    }
    return rest;
}

SystemDescription read(std::span<const fs::path> files, Model& model) {
    const Paths existing = withoutFolders(files, model.report);
    ModelFiles read = readModelFiles(existing, model.report);
    model.files = std::move(read.files);
    model.hasSystem = read.hasSystem;
    model.tree = std::make_unique<SimplexTree>(std::move(read.types));
    return std::move(read.system);
}

// The simplex of the agent itself, as a running one has it.
void addAgents(SimplexTree& tree) {
    const bool cluster = tree.types().find("Cluster") != nullptr;
    if (!cluster && tree.types().find("Agent") == nullptr) return;  // validate() says so
    for (const auto& each : tree.description().clusters) {
        const std::string path = "/" + each.name;
        const bool possible = SimplexTree::pathError(path).empty() && tree.find(path) == nullptr;
        if (possible) tree.add(path, cluster ? "Cluster" : "Agent");
    }
}

}  // namespace

Model readTypes(std::span<const fs::path> files) {
    Model model;
    read(files, model);
    return model;
}

Model readSystem(std::span<const fs::path> files) {
    Model model;
    const SystemDescription system = read(files, model);
    model.tree->add(system, nullptr, model.report);
    addAgents(*model.tree);
    model.tree->createRelated();
    // Without a system, what validate() says of types alone needs the base types.
    const bool whole = model.hasSystem || model.types().find("Agent") != nullptr;
    if (whole) model.report.append(validate(*model.tree));
    return model;
}

bool lacksFile(const Report& report) {
    return std::ranges::any_of(report.findings, [](const Finding& finding) {
        return finding.rule == fileMissing && finding.place.line == 0;
    });
}

void requireValid(const Model& model) {
    if (model.report.ok()) {
        printFindings(model.report, Stream::Errors);
        return;
    }
    const bool lacking = lacksFile(model.report);
    throw Failure{lacking ? NotFound : No,
                  lacking ? "a file cannot be read" : "the model has errors", model.report};
}

}  // namespace cortex::explorer
