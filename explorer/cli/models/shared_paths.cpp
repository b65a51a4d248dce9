// SPDX-License-Identifier: Apache-2.0
#include "models/shared_paths.hpp"

#include <map>
#include <string>
#include <string_view>

namespace cortex::cli {
namespace {

using First = std::map<std::string_view, Place>;  // by name, or by path

void checkAgents(Model& model, First& first) {
    for (const auto& cluster : model.tree->description().clusters) {
        const auto [before, isNew] = first.try_emplace(cluster.name, cluster.place);
        if (isNew) continue;
        model.report.error("/" + cluster.name, "agent-twice", cluster.place,
                           "an agent of this name is in " + before->second.text() +
                               " as well, and the second start of a name is refused",
                           "write <cluster name=\"…\"/> with another name");
    }
}

void checkPaths(Model& model, const First& agents, First& first) {
    for (const auto& [path, simplex] : model.tree->simplexes()) {
        if (agents.contains(std::string_view{path}.substr(1))) continue;
        const auto [before, isNew] = first.try_emplace(path, simplex->place());
        if (isNew) continue;
        model.report.warning(
            path, "path-twice", simplex->place(),
            before->second.text() +
                " has a simplex of this path in another agent: while both run, the "
                "later one refuses commands to it",
            "give one of them another path, unless one is the other's spare");
    }
}

}  // namespace

void checkSharedPaths(std::span<Model* const> systems) {
    First agents, paths;
    for (Model* each : systems) checkAgents(*each, agents);
    for (Model* each : systems) checkPaths(*each, agents, paths);
}

}  // namespace cortex::cli
