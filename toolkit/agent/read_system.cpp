// SPDX-License-Identifier: Apache-2.0
#include "read_system.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/model_files.hpp"
#include "cortex/cs/cluster_cs.hpp"

#include "plugin_folders.hpp"
#include "stored_values.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace cortex::toolkit {
namespace {

// A file that is written: neither read by this agent, as a model or settings, nor written twice.
void refuseToWrite(const CommandLine& line, const ModelFiles& model) {
    namespace fs = std::filesystem;
    std::vector<fs::path> read = model.files;
    if (!line.settingsFile.empty()) read.push_back(line.settingsFile);
    const auto refuse = [](const std::string& option, const fs::path& file, const char* why) {
        throw UsageError(option + " " + file.string() + ": it is " + why + ": name another file");
    };
    std::set<fs::path> written;
    for (const auto& [option, file] :
         {std::pair{"--log", line.log}, std::pair{"--retain", line.retainFile},
          std::pair{"--memory", line.memoryFile}}) {
        if (file.empty()) continue;
        const bool isRead = std::ranges::any_of(read, [&target = file](const fs::path& each) {
            std::error_code ignored;
            return fs::equivalent(target, each, ignored);
        });
        if (isRead) refuse(option, file, "read by this agent, and would be written over");
        if (!written.insert(fs::absolute(file).lexically_normal()).second)
            refuse(option, file, "that of another option as well");
    }
}

ModelFiles readFiles(const CommandLine& line) {
    Report report;
    const std::array files{line.system};
    ModelFiles model = readModelFiles(files, report);
    if (!model.hasSystem && report.ok()) {
        report.error("", "no-system", {line.system.string(), 1}, "the file has no <system>",
                     "give a system file, or write one around it");
    }
    if (!report.ok()) throw ModelError(std::move(report));
    refuseToWrite(line, model);
    return model;
}

void applySettings(const CommandLine& line, SimplexTree& tree) {
    try {
        std::set<std::string> given;
        for (const std::string& setting : line.settings) applySetting(tree, setting, given);
    } catch (const UsageError&) {
        throw;
    } catch (const Error& error) {
        throw UsageError(std::string{"--set: "} + error.what());
    }
}

// A destructor of a plug-in may hang.
void destroy(SimplexTree* tree) {
    const cs::BoundedStep step{"the destructors of the simplexes"};
    delete tree;
}

}  // namespace

OwnedTree readSystem(const CommandLine& line, ClassRegistry& registry,
                     const std::function<void(SimplexTree&)>& restore) {
    ModelFiles model = readFiles(line);
    for (const auto& plugin : line.plugins) {
        const cs::BoundedStep step{"loading the plug-in " + plugin.string()};
        registry.loadPlugin(plugin, model.types);
    }
    OwnedTree tree{new SimplexTree{std::move(model.types)}, &destroy};
    for (const std::string& problem : offerPlugins(tree->sharedTypes(), registry))
        std::cerr << problem << std::endl;
    const cs::BoundedStep step{"making the simplexes of " + line.system.string()};
    Report report;
    tree->add(model.system, &registry, report);
    if (!report.ok()) throw ModelError(std::move(report));
    tree->createRelated(&registry);
    if (!line.settingsFile.empty()) std::cout << applySettingsFile(line.settingsFile, *tree);
    if (restore) restore(*tree);
    std::cout << std::flush;
    applySettings(line, *tree);
    return tree;
}

}  // namespace cortex::toolkit
