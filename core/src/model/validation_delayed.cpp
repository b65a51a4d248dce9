// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/system_findings.hpp"

#include "model/remedies.hpp"
#include "model/resolved_relations.hpp"
#include "model/validation_checks.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace cortex {
namespace {

bool isDevice(const Simplex& simplex) { return simplex.type().isA("Device"); }

// Whoever it is, a device does what stands there.
using Paths = std::unordered_set<std::string_view>;
Paths doneByDevices(const SimplexTree& tree) {
    Paths paths;
    for (const auto& [path, simplex] : tree.simplexes()) {
        if (!isDevice(*simplex)) continue;
        for (const auto& [relation, rule, target] : resolveRelations(tree, *simplex)) {
            if (countsFor(simplex->type(), rule->name, "demands")) paths.insert(relation->target);
        }
    }
    return paths;
}

// By index, by who acts. If others delay the same simplex, that is told already.
std::vector<bool> writtenAtOnce(const Structure& structure) {
    std::vector<bool> written(structure.simplexes.size(), false);
    for (const Edge& edge : structure.edges) {
        const bool isActive = structure.simplexes[edge.owner].role == Role::Active;
        if (isActive && edge.rule->direction == Direction::Output && !edge.delayed)
            written[edge.target] = true;
    }
    return written;
}

std::vector<std::string> itemsWithSafe(const Type& type) {
    std::vector<std::string> names;
    for (const DataItem& item : type.data) {
        if (item.safe.kind == Safe::Kind::None || item.constant) continue;
        const std::string place = item.place.text();
        names.push_back("'" + item.name + "'" + (place.empty() ? "" : " (" + place + ")"));
    }
    return names;
}

void report(const Checked& checked, const Simplex& owner, const ResolvedRelation& written) {
    const Rule& rule = *written.rule;
    const std::string& path = written.target->path();
    const auto names = itemsWithSafe(written.target->type());
    if (names.empty()) return;
    Simplex::Relation atOnce = *written.relation;
    atOnce.delayed = false;
    const std::string undo = rule.delayed ? "remove delayed=\"true\" from " + ruleText(owner, rule)
                                          : "write " + relateText(atOnce);
    checked.report.error(
        owner.path(), finding::delayedSafe, written.relation->place,
        ruleText(owner, rule) + " is delayed, so " + path + " is an observation, and safe of " +
            listText(names) +
            " is ignored: in Standby and Fault the last value that was written stands",
        undo +
            "; if nobody is to do what stands there, relate a simplex of a type with "
            "role=\"observation\"");
}

// A delayed output to a simplex whose role is open.
struct Written {
    const Simplex* owner;
    ResolvedRelation relation;
};
std::vector<Written> writtenDelayed(const SimplexTree& tree) {
    std::vector<Written> all;
    const auto delays = [](const auto& each) { return each.delayed; };
    for (const auto& [path, simplex] : tree.simplexes()) {
        if (!simplex->type().active() || isDevice(*simplex)) continue;
        if (std::ranges::none_of(simplex->relations(), delays) &&
            std::ranges::none_of(simplex->type().rules, delays)) {
            continue;
        }
        for (const auto& each : resolveRelations(tree, *simplex)) {
            if (each.rule->direction != Direction::Output || !each.delayed()) continue;
            const bool isOpen =
                each.target != nullptr && each.target->type().role == Role::Descriptive;
            if (isOpen) all.push_back({simplex.get(), each});
        }
    }
    return all;
}

}  // namespace

// A delayed output of a device observes. One of a controller, or one that a device follows,
// demands.
void checkDelayedDemands(const Checked& checked) {
    const std::vector<Written> all = writtenDelayed(checked.tree);
    if (all.empty()) return;
    const Paths done = doneByDevices(checked.tree);
    const std::vector<bool> atOnce = writtenAtOnce(checked.structure);
    for (const auto& [owner, relation] : all) {
        const std::string& path = relation.target->path();
        const bool demands = owner->type().isA("Controller") ||
                             !relation.rule->counterpart.empty() || done.contains(path);
        if (demands && !atOnce[checked.structure.find(path)]) report(checked, *owner, relation);
    }
}

}  // namespace cortex
