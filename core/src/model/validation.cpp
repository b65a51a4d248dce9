// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/validation.hpp"

#include "cortex/core/crossed_pairs.hpp"
#include "cortex/core/error.hpp"
#include "cortex/core/make_structure.hpp"
#include "cortex/core/system_findings.hpp"

#include "model/remedies.hpp"
#include "model/validation_checks.hpp"

#include <array>

namespace cortex {
namespace {

constexpr int mostEvery = 1'000'000;  // cycles: others read no more (peer_structure.cpp)

void checkAgentType(const Checked& checked) {
    if (checked.tree.types().find("Agent") != nullptr) return;
    const auto& description = checked.tree.description();
    const std::string path = description.clusters.empty() ? "" : description.clusters.front().name;
    checked.report.error("/" + path, finding::agentType, description.place,
                         "the ontology has no type 'Agent', which the agent's own simplex is of",
                         "include base.xml: <ontology file=\"base.xml\"/>");
}

void checkClusterPath(const Checked& checked) {
    for (const auto& cluster : checked.tree.description().clusters) {
        const std::string path = "/" + cluster.name;
        const Simplex* taken = checked.tree.find(path);
        if (taken == nullptr || taken->type().isA("Agent")) continue;
        checked.report.error(path, finding::clusterPath, taken->place(),
                             "the path is the cluster's own (" + cluster.place.text() +
                                 "), but the simplex is a " + taken->type().name,
                             "write path=\"" + path + "-plant\", or name the cluster otherwise");
    }
}

void checkAbstract(const Checked& checked, const Simplex& simplex) {
    const Type& type = simplex.type();
    if (!type.isAbstract) return;
    const auto names = concreteTypes(checked.tree.types(), type.name);
    std::string remedy = "add a type that extends " + type.name;
    if (!names.empty()) remedy = "write type=\"" + names.front() + "\"";
    if (names.size() > 1) remedy += "; there are " + listText(names);
    checked.report.error(simplex.path(), finding::abstractType, simplex.place(),
                         "type " + type.name + " is abstract: nothing can be one and no more",
                         remedy);
}

void checkRate(const Checked& checked, const Simplex& simplex) {
    const std::string every = std::to_string(simplex.every());
    if (simplex.every() < 1) {
        checked.report.error(simplex.path(), finding::everyRange, simplex.place(),
                             "every=\"" + every + "\": a simplex runs every 1st, 2nd, … cycle",
                             "write every=\"1\"");
    } else if (simplex.every() > mostEvery) {
        checked.report.error(simplex.path(), finding::everyRange, simplex.place(),
                             "every=\"" + every + "\": other agents read at most 1000000",
                             "write every=\"1000000\" or less");
    } else if (simplex.phase() < -1 || simplex.phase() >= simplex.every()) {
        checked.report.error(simplex.path(), finding::phaseRange, simplex.place(),
                             "phase=\"" + std::to_string(simplex.phase()) +
                                 "\" is not below every=\"" + every + "\"",
                             "write phase=\"0\"");
    } else if (simplex.every() > 1 && !simplex.type().active()) {
        checked.report.error(simplex.path(), finding::everyWithoutTask, simplex.place(),
                             "every=\"" + every + "\": its type " + simplex.type().name + " is " +
                                 name(simplex.type().role) + ", so it has no task",
                             "leave every out; its writer says how often it changes");
    }
}

}  // namespace

void checkModel(const Checked& checked) {
    checkAgentType(checked);
    checkClusterPath(checked);
    checkAngles(checked);
}

void checkSimplex(const Checked& checked, const Simplex& simplex) {
    checkAbstract(checked, simplex);
    checkRate(checked, simplex);
}

Report validate(const SimplexTree& tree, Extent extent) {
    Report report;
    std::shared_ptr<const Structure> structure;
    try {
        structure = makeStructure("", tree);
    } catch (const ModelError& tooLarge) {
        return tooLarge.report();
    }
    Checked checked{tree, *structure, report, {}};
    for (const auto& entry : tree.description().simplexes) checked.declared.insert(entry.path);
    checkModel(checked);
    for (const auto& [path, simplex] : tree.simplexes()) {
        checkSimplex(checked, *simplex);
        checkRelations(checked, *simplex);
        checkCounts(checked, *simplex);
        checkUnits(checked, *simplex);
        checkSettings(checked, *simplex);
        checkAboveOther(checked, *simplex);
        checkAges(checked, *simplex);
    }
    checkCrossedPairs(tree, std::array{&tree}, report);
    checkFlow(checked);
    if (extent == Extent::Whole) checkUnwritten(checked);
    checkDelayedDemands(checked);
    return report;
}

}  // namespace cortex
