// SPDX-License-Identifier: Apache-2.0
#include "models/model.hpp"

#include "cortex/core/make_structure.hpp"
#include "cortex/core/sending_checks.hpp"
#include "cortex/core/validation.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace cortex::cli {
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

// An agent is one cluster: whoever runs this system says the same.
void checkClusters(const SystemDescription& system, Report& report) {
    const std::size_t count = system.clusters.size();
    if (count == 0) {
        report.warning("", "cluster-count", system.place,
                       "the system has no cluster; only a program that names its agent can run it",
                       "write <cluster name=\"…\" frequency=\"1000\"/>");
    } else if (count > 1) {
        report.error("/" + system.clusters[1].name, "cluster-count", system.clusters[1].place,
                     "the system has " + std::to_string(count) + " clusters, an agent runs one",
                     "keep one of them, and write a system file for each other");
    }
    for (const auto& cluster : system.clusters) {
        const std::string wrong = SimplexTree::pathError("/" + cluster.name);
        const bool level = cluster.name.find('/') == std::string::npos;
        if (level && wrong.empty()) continue;
        report.error("/" + cluster.name, "malformed-path", cluster.place,
                     "the cluster's name '" + cluster.name + "' is no path of one level",
                     "use A-Z a-z 0-9 _ -, at most 127 characters");
    }
}

// Whether a file could not be read, so that what it may contain is unknown.
bool lacksPart(const Report& report) {
    return std::ranges::any_of(report.findings, [](const Finding& finding) {
        return finding.rule.starts_with("file-") || finding.rule.starts_with("xml-");
    });
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

bool isSystem(const fs::path& file) { return readTypes(std::array{file}).hasSystem; }

Model readTypes(std::span<const fs::path> files) {
    Model model;
    read(files, model);
    return model;
}

Model readSystem(std::span<const fs::path> files) {
    Model model;
    const SystemDescription system = read(files, model);
    model.tree->add(system, nullptr, model.report);
    if (model.hasSystem) checkClusters(model.tree->description(), model.report);
    addAgents(*model.tree);
    model.tree->createRelated();
    // Without the base types, validate() has nothing to judge by. Whether they are missing is known
    // only if every file was read.
    const bool whole =
        model.types().find("Agent") != nullptr || (model.hasSystem && !lacksPart(model.report));
    if (whole) {
        // Without a cluster it is a part of others, such as an arm that several cells include.
        const bool isPart = model.tree->description().clusters.empty();
        model.report.append(validate(*model.tree, isPart ? Extent::Part : Extent::Whole));
    }
    if (whole && model.report.ok()) {
        model.report.append(checkSending(*model.tree, *makeStructure("", *model.tree)));
    }
    return model;
}

bool lacksFile(const Report& report) {
    return std::ranges::any_of(report.findings, [](const Finding& finding) {
        return finding.rule == fileMissing && finding.place.line == 0;
    });
}

Report joinReports(std::span<const Model* const> models) {
    Report all;
    std::set<std::string> known;
    for (const Model* model : models) {
        for (const Finding& finding : model->report.findings) {
            if (known.insert(finding.rule + finding.text()).second) all.add(finding);
        }
    }
    return all;
}

void requireValid(std::span<const Model* const> models) {
    Report report = joinReports(models);
    if (report.ok()) {
        printFindings(report, Stream::Errors);
        return;
    }
    const bool lacking = lacksFile(report);
    throw Failure{lacking ? NotFound : No,
                  lacking ? "a file cannot be read" : "the model has errors", std::move(report)};
}

void requireValid(const Model& model) { requireValid(std::array{&model}); }

}  // namespace cortex::cli
