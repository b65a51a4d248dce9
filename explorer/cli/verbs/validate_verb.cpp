// SPDX-License-Identifier: Apache-2.0
#include "models/remote_paths.hpp"
#include "models/shared_paths.hpp"
#include "models/start_check.hpp"
#include "verbs/verbs.hpp"

#include <algorithm>
#include <array>
#include <iostream>
#include <set>

namespace cortex::cli {
namespace {

struct Checked {
    Paths files;  // as named
    Model model;
    bool isStartChecked = false;
};

// Files make one model together; of several systems each is a model with all other files, and what
// they read of each other is compared.
std::vector<Checked> check(const Paths& files) {
    Paths systems, others;
    if (files.size() > 1) {
        for (const auto& file : files) {
            (isSystem(file) ? systems : others).push_back(file);
        }
    }
    std::vector<Checked> checked;
    if (systems.size() < 2) {
        checked.push_back({files, readSystem(files)});
        checkRemotePaths(std::array{&checked.front().model});
        return checked;
    }
    for (const auto& system : systems) {
        Paths together = others;
        together.push_back(system);
        checked.push_back({{system}, readSystem(together)});
    }
    std::vector<Model*> models;
    for (Checked& each : checked) models.push_back(&each.model);
    checkSharedPaths(models);
    checkRemotePaths(models);
    return checked;
}

// A model without errors, which may still have what the classes of its active types refuse.
void checkStarts(std::vector<Checked>& checked, const ValidateOptions& options) {
    if (options.modelOnly) return;
    for (Checked& each : checked) {
        const bool isSystem =
            each.model.hasSystem && !each.model.tree->description().clusters.empty();
        if (!isSystem || !each.model.report.ok()) continue;
        each.isStartChecked = checkStart(each.model, each.files, options.plugins);
    }
}

Report join(const std::vector<Checked>& checked) {
    std::vector<const Model*> models;
    for (const Checked& each : checked) models.push_back(&each.model);
    return joinReports(models);
}

// ", 1 warning, 2 notes"
std::string lesserText(const Report& report) {
    const auto count = [&](Severity severity) {
        return static_cast<std::size_t>(
            std::ranges::count(report.findings, severity, &Finding::severity));
    };
    const std::size_t warnings = count(Severity::Warning), notes = count(Severity::Info);
    return (warnings > 0 ? ", " + plural(warnings, "warning") : "") +
           (notes > 0 ? ", " + plural(notes, "note") : "");
}

void printValid(const Checked& checked) {
    const Model& model = checked.model;
    const auto& simplexes = model.tree->simplexes();
    const auto active = std::ranges::count_if(
        simplexes, [](const auto& each) { return each.second->type().active(); });
    std::size_t rules = 0;
    for (const auto& [name, type] : model.types().declarations()) rules += type.rules.size();
    std::cout << printable(checked.files.size() == 1 ? checked.files.front().string()
                                                     : plural(checked.files.size(), "file"))
              << (model.hasSystem && !checked.isStartChecked ? ": valid as a model, " : ": valid, ")
              << (model.hasSystem
                      ? plural(simplexes.size(), "simplex") + ", " + std::to_string(active) +
                            " active"
                      : plural(model.types().types().size(), "type") + ", " + plural(rules, "rule"))
              << lesserText(joinReports(std::array{&model})) << '\n';
}

void printSummary(const Report& report) {
    std::set<std::string> files;
    for (const Finding& finding : report.findings) files.insert(finding.place.file);
    files.erase("");
    std::cout << plural(report.errors(), "error") << lesserText(report)
              << (files.empty() ? "" : " in " + plural(files.size(), "file")) << '\n';
}

}  // namespace

Exit validateFiles(const ValidateOptions& options) {
    auto checked = check(options.files);
    checkStarts(checked, options);
    const Report report = join(checked);
    if (options.json) {
        print({{"findings", findingsJson(report)}});
    } else {
        printFindings(report, Stream::Output);
        for (const Checked& each : checked) {
            if (each.model.report.ok()) printValid(each);
        }
        if (!report.ok()) printSummary(report);
    }
    if (lacksFile(report)) return NotFound;
    return report.ok() ? Yes : No;
}

}  // namespace cortex::cli
