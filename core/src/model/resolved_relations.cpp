// SPDX-License-Identifier: Apache-2.0
#include "model/resolved_relations.hpp"

#include <algorithm>
#include <functional>

namespace cortex {

std::vector<ResolvedRelation> resolveRelations(const SimplexTree& tree, const Simplex& owner) {
    std::vector<ResolvedRelation> resolved;
    for (const auto& relation : owner.relations()) {
        const Rule* rule = owner.type().findRule(relation.rule);
        const Simplex* target = tree.find(relation.target);
        if (rule != nullptr && (relation.remote || target != nullptr)) {
            resolved.push_back({&relation, rule, target});
        }
    }
    std::ranges::sort(resolved, [](const auto& left, const auto& right) {
        if (left.rule != right.rule) return left.rule->name < right.rule->name;
        return std::less<>{}(left.relation, right.relation);
    });
    return resolved;
}

bool countsFor(const Type& type, std::string_view related, std::string_view rule) {
    for (std::size_t steps = 0; steps <= type.rules.size(); ++steps) {
        if (related == rule) return true;
        const Rule* found = type.findRule(related);
        if (found == nullptr || found->refines.empty()) return false;
        related = found->refines;
    }
    return false;  // rules that refine each other
}

std::vector<const Simplex::Relation*> relationsFor(const Simplex& owner, const Rule& rule) {
    std::vector<const Simplex::Relation*> counted;
    for (const auto& relation : owner.relations()) {
        if (countsFor(owner.type(), relation.rule, rule.name)) counted.push_back(&relation);
    }
    return counted;
}

std::string createdPath(const Simplex& owner, const Rule& rule, std::uint32_t n) {
    const std::string path = owner.path() + "/" + rule.name;
    return rule.max == 1 ? path : path + "/" + std::to_string(n);
}

const Type* createdType(const TypeModel& types, const Rule& rule, std::uint32_t n) {
    if (rule.create.empty()) return nullptr;
    const std::size_t position = std::min<std::size_t>(n, rule.create.size());
    return types.find(rule.create[position - 1]);
}

}  // namespace cortex
