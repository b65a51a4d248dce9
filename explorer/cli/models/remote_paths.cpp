// SPDX-License-Identifier: Apache-2.0
#include "models/remote_paths.hpp"

#include "cortex/core/crossed_pairs.hpp"
#include "cortex/core/nearest_names.hpp"
#include "cortex/core/structure.hpp"
#include "cortex/core/transport.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::cli {
namespace {

constexpr const char* remotePath = "remote-path";

// Of the type as the reader has it; null: its own report says what is wrong.
const Type* readAs(const Model& reader, const Simplex& owner, const Simplex::Relation& relation) {
    if (!relation.type.empty()) return reader.types().find(relation.type);
    const auto& rules = owner.type().rules;
    const auto rule = std::ranges::find(rules, relation.rule, &Rule::name);
    return rule == rules.end() ? nullptr : reader.types().find(rule->target);
}

void addMissing(Model& reader, const Simplex& owner, const Simplex::Relation& relation,
                std::span<Model* const> systems) {
    std::vector<std::string> paths;
    for (const Model* each : systems) {
        if (each == &reader) continue;
        for (const auto& [path, simplex] : each->tree->simplexes()) paths.push_back(path);
    }
    const std::string nearest = nearestNames(relation.target, paths);
    reader.report.warning(owner.path(), remotePath, relation.place,
                          "rule '" + relation.rule + "' names " + relation.target +
                              " of another agent, but no system given has it",
                          nearest.empty() ? "give the system file of that agent as well" : nearest);
}

void compareTypes(Model& reader, const Simplex& owner, const Simplex::Relation& relation,
                  const Model& other, const Simplex& target) {
    const Type* wanted = readAs(reader, owner, relation);
    if (wanted == nullptr) return;
    const LinkBinding link = compileLink(typeLayout(*wanted, true), typeLayout(target.type()),
                                         reader.types(), other.types());
    for (Finding finding : link.findings.findings) {
        finding.path = owner.path();
        finding.place = relation.place;
        finding.message = "rule '" + relation.rule + "' reads " + target.path() + " (" +
                          target.type().name + ", " + target.place().text() +
                          "): " + finding.message;
        reader.report.add(finding);
    }
}

// Of a system alone: nothing is wrong with it, and nothing is known of the other.
void noteUnchecked(Model& reader, const Simplex& owner, const Simplex::Relation& relation) {
    reader.report.add({Severity::Info, owner.path(), remotePath, relation.place,
                       "not checked: " + relation.target + " of another agent",
                       "add its system file to check both together"});
}

void checkRelation(Model& reader, const Simplex& owner, const Simplex::Relation& relation,
                   std::span<Model* const> systems) {
    for (const Model* each : systems) {
        const Simplex* target = each->tree->find(relation.target);
        if (target == nullptr) continue;
        if (each != &reader) compareTypes(reader, owner, relation, *each, *target);
        return;
    }
    if (systems.size() == 1)
        noteUnchecked(reader, owner, relation);
    else
        addMissing(reader, owner, relation, systems);
}

// A drive of one agent that a processor of another one leads.
void checkPairs(Model& writer, std::span<Model* const> systems) {
    std::vector<const SimplexTree*> others;
    for (const Model* each : systems) {
        if (each != &writer) others.push_back(each->tree.get());
    }
    checkCrossedPairs(*writer.tree, others, writer.report);
}

}  // namespace

void checkRemotePaths(std::span<Model* const> systems) {
    for (Model* reader : systems) {
        std::set<std::string_view> noted;
        for (const auto& [path, simplex] : reader->tree->simplexes()) {
            for (const Simplex::Relation& relation : simplex->relations()) {
                const bool again = systems.size() == 1 && !noted.insert(relation.target).second;
                if (relation.remote && !again) checkRelation(*reader, *simplex, relation, systems);
            }
        }
        checkPairs(*reader, systems);
    }
}

}  // namespace cortex::cli
