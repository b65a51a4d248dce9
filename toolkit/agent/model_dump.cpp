// SPDX-License-Identifier: Apache-2.0
#include "model_dump.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/nearest_names.hpp"
#include "cortex/cs/cluster_cs.hpp"

#include "model_text.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include <unistd.h>

namespace cortex::toolkit {
namespace {

constexpr const char* dumpOption = "--dump-mjcf";

struct StartEnded {};

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

[[noreturn]] void failed(const char* doing) {
    throw Error(std::string{dumpOption} + ": " + doing + ": " + std::strerror(errno));
}

}  // namespace

int setStandardOutputAside() {
    std::fflush(stdout);
    const int former = dup(STDOUT_FILENO);
    if (former < 0 || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) failed("the standard output");
    return former;
}

std::string modelText(const CommandLine& line, const ClassRegistry& registry, SimplexTree& tree) {
    const ClusterSettings settings = clusterSettings(tree.description(), line);
    const HasModelText& model = chosen(line, tree);
    std::string text;
    cs::ClusterCS cluster{settings.name, settings.options};
    cluster.addSimplexTree(tree);
    cluster.useClasses(registry);
    cluster.setTriggerSource<cs::ManualTrigger>(settings.period);
    cluster.beforeFirstCycle([&] {
        text = model.modelText();
        throw StartEnded{};
    });
    try {
        cluster.start();
    } catch (const StartEnded&) {
        if (!text.ends_with('\n')) text += '\n';
    }
    return text;
}

void writeModel(int descriptor, const std::string& text) {
    const std::unique_ptr<FILE, int (*)(FILE*)> file{fdopen(descriptor, "w"), &std::fclose};
    if (file == nullptr || std::fwrite(text.data(), 1, text.size(), file.get()) != text.size() ||
        std::fflush(file.get()) != 0) {
        failed("the model could not be written");
    }
}

}  // namespace cortex::toolkit
