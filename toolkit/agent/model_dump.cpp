// SPDX-License-Identifier: Apache-2.0
#include "model_dump.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/nearest_names.hpp"
#include "cortex/core/simplex_tree.hpp"
#include "cortex/toolkit/classes.hpp"

#include "dry_start.hpp"
#include "model_text.hpp"
#include "read_system.hpp"

#include <string>
#include <vector>

namespace cortex::toolkit {
namespace {

constexpr const char* dumpOption = "--dump-mjcf";

const HasModelText* modelOf(const Simplex& simplex) {
    return dynamic_cast<const HasModelText*>(&simplex);
}

std::vector<std::string> pathsOfModels(const SimplexTree& tree) {
    std::vector<std::string> paths;
    for (const auto& [path, simplex] : tree.simplexes()) {
        if (modelOf(*simplex) != nullptr) paths.push_back(path);
    }
    return paths;
}

std::string listed(const std::vector<std::string>& paths) {
    std::string text;
    for (const std::string& path : paths) text += (text.empty() ? "" : ", ") + path;
    return text;
}

// Of several, or of one that is none.
const HasModelText& chosen(const CommandLine& line, const SimplexTree& tree) {
    const std::vector<std::string> paths = pathsOfModels(tree);
    if (paths.empty()) {
        throw Error(line.system.string() + ": no simplex has a model as MJCF; a MujocoWorld " +
                    "has one (physics-morphology.xml)");
    }
    if (line.modelPath.empty() && paths.size() > 1) {
        throw UsageError(std::string{dumpOption} + ": " + line.system.string() + " has " +
                         std::to_string(paths.size()) +
                         " models; add the path of one: " + listed(paths));
    }
    const std::string& path = line.modelPath.empty() ? paths.front() : line.modelPath;
    const std::string asked = std::string{dumpOption} + " " + path + ": ";
    const Simplex* simplex = tree.find(path);
    if (simplex == nullptr) {
        const std::string nearest = nearestNames(path, paths);
        throw UsageError(asked + "no simplex has this path; " +
                         (nearest.empty() ? "these have a model: " + listed(paths) : nearest));
    }
    const HasModelText* model = modelOf(*simplex);
    if (model == nullptr) {
        throw UsageError(asked + "a " + simplex->type().name +
                         " has no model; these have one: " + listed(paths));
    }
    return *model;
}

}  // namespace

void dumpModel(const CommandLine& line) {
    const OutputAside output;
    ClassRegistry registry;
    addClasses(registry);
    const OwnedTree tree = readSystem(line, registry);
    const HasModelText& model = chosen(line, *tree);
    std::string text;
    dryStart(line, registry, *tree, [&](cs::ClusterCS&) { text = model.modelText(); });
    if (!text.ends_with('\n')) text += '\n';
    output.write(text);
}

}  // namespace cortex::toolkit
