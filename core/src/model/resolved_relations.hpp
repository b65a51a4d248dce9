// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/simplex_tree.hpp"

#include <string_view>
#include <vector>

namespace cortex {

// A relation of a simplex with what its names stand for; `target` is null where another agent has
// it.
struct ResolvedRelation {
    const Simplex::Relation* relation = nullptr;
    const Rule* rule = nullptr;
    const Simplex* target = nullptr;

    bool delayed() const { return relation->delayed || rule->delayed; }
    double maxAge() const { return relation->maxAge == 0 ? rule->maxAge : relation->maxAge; }
    const Type* wantedType(const TypeModel& types) const {  // of a remote target
        const Type* stated = types.find(relation->type);
        const bool fits = stated != nullptr && stated->isA(rule->target);
        return fits ? stated : types.find(rule->target);
    }
};

// By rule, then in the order related: the order of Structure::edges. Names that stand for nothing
// are left out; validate() reports them.
std::vector<ResolvedRelation> resolveRelations(const SimplexTree& tree, const Simplex& owner);

// Whether relationships under `related` count for `rule`: the same rule, or one that refines it.
bool countsFor(const Type& type, std::string_view related, std::string_view rule);
std::vector<const Simplex::Relation*> relationsFor(const Simplex& owner, const Rule& rule);

// Path and type of the n-th simplex (from 1) that a rule with `create` makes for its owner. The
// type is null if the model lacks it.
std::string createdPath(const Simplex& owner, const Rule& rule, std::uint32_t n);
const Type* createdType(const TypeModel& types, const Rule& rule, std::uint32_t n);

inline constexpr std::size_t maxSimplexes = 100'000;  // no tree is filled beyond it

}  // namespace cortex
