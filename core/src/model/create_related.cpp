// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/simplex_tree.hpp"

#include "model/resolved_relations.hpp"

#include <algorithm>
#include <deque>
#include <optional>

namespace cortex {
namespace {

using Slots = std::vector<std::optional<Simplex::Relation>>;

// Position under `rule` that a path is named for, or 0: "/lbr/axes/3" is 3.
std::size_t positionOf(const Simplex& owner, const Rule& rule, const std::string& path) {
    const auto n = toInt(std::string_view{path}.substr(path.rfind('/') + 1)).value_or(1);
    const bool inRange = n >= 1 && n <= rule.min;
    return inRange && createdPath(owner, rule, static_cast<std::uint32_t>(n)) == path
               ? static_cast<std::size_t>(n)
               : 0;
}

// The relations of a rule by position, empty where one is to be created: what is related already to
// a created path stands in its place, the others fill up in their order.
Slots slotsOf(const Simplex& owner, const Rule& rule) {
    const std::size_t all = relationsFor(owner, rule).size();
    std::deque<Simplex::Relation> others;
    std::map<std::size_t, Simplex::Relation> named;
    for (const auto& relation : owner.relations()) {
        if (relation.rule != rule.name) continue;
        const std::size_t n = positionOf(owner, rule, relation.target);
        if (n == 0 || !named.emplace(n, relation).second) others.push_back(relation);
    }
    const std::size_t refining = all - named.size() - others.size();
    Slots slots(std::min<std::size_t>(rule.min - refining, maxSimplexes));
    for (auto& [n, relation] : named) {
        if (n <= slots.size())
            slots[n - 1] = relation;
        else
            others.push_back(relation);
    }
    for (auto& slot : slots) {
        if (slot || others.empty()) continue;
        slot = others.front();
        others.pop_front();
    }
    slots.insert(slots.end(), others.begin(), others.end());
    return slots;
}

}  // namespace

Simplex* SimplexTree::createOne(const Simplex& owner, const Rule& rule, std::uint32_t n,
                                const ClassRegistry* registry) {
    const std::string path = createdPath(owner, rule, n);
    const Type* type = createdType(*types_, rule, n);
    if (type == nullptr) return nullptr;
    if (Simplex* taken = find(path)) return taken->type().isA(type->name) ? taken : nullptr;
    const bool possible =
        !type->isAbstract && pathError(path).empty() && simplexes_.size() < maxSimplexes;
    if (!possible) return nullptr;
    Simplex& created = insert(make(path, *type, registry));
    created.description_->place = owner.place();
    return &created;
}

// What cannot be created leaves its rule below the minimum, which validate() reports.
void SimplexTree::createRelated(const ClassRegistry* registry) {
    std::deque<Simplex*> waiting;
    for (const auto& [path, simplex] : simplexes_) waiting.push_back(simplex.get());
    for (; !waiting.empty(); waiting.pop_front()) {
        Simplex& owner = *waiting.front();
        for (const Rule& rule : owner.type().rules) {
            if (rule.create.empty() || relationsFor(owner, rule).size() >= rule.min) continue;
            const Slots slots = slotsOf(owner, rule);
            std::erase_if(owner.description_->relations,
                          [&](const auto& each) { return each.rule == rule.name; });
            for (std::uint32_t n = 1; n <= slots.size(); ++n) {
                if (const auto& slot = slots[n - 1]) {
                    owner.description_->relations.push_back(*slot);
                    continue;
                }
                const std::size_t before = simplexes_.size();
                Simplex* related = createOne(owner, rule, n, registry);
                if (related == nullptr) continue;
                if (simplexes_.size() > before) waiting.push_back(related);
                owner.description_->relations.push_back(
                    {rule.name, related->path(), false, false, owner.place()});
            }
        }
    }
    for (const auto& [path, simplex] : simplexes_) simplex->description_->relations.shrink_to_fit();
}

}  // namespace cortex
