// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/make_structure.hpp"

#include "cortex/core/data.hpp"
#include "cortex/core/error.hpp"
#include "cortex/core/system_findings.hpp"

#include "base/bounds.hpp"
#include "model/resolved_relations.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace cortex {
namespace {

const TypeLayout* layoutFor(Structure& structure, const Type& type, bool remote = false) {
    auto& layouts = structure.layouts;
    const auto found = std::ranges::find_if(
        layouts, [&](const auto& each) { return each->type == &type && each->remote == remote; });
    if (found != layouts.end()) return found->get();
    return layouts.emplace_back(std::make_unique<TypeLayout>(typeLayout(type, remote))).get();
}

void addSimplexes(Structure& structure, const SimplexTree& tree) {
    structure.simplexes.reserve(tree.simplexes().size());
    for (const auto& [path, simplex] : tree.simplexes()) {
        SimplexInfo info;
        info.path = path;
        info.layout = layoutFor(structure, simplex->type());
        info.role = simplex->type().role;
        info.every = static_cast<std::uint32_t>(std::max(1, simplex->every()));
        info.phase = simplex->phase();
        structure.simplexes.push_back(std::move(info));
    }
}

// A path that several rules name gets the most derived of the types that are wanted.
void addRemotes(Structure& structure, const SimplexTree& tree) {
    std::map<std::string, const Type*> remotes;
    for (const auto& [path, simplex] : tree.simplexes()) {
        for (const auto& resolved : resolveRelations(tree, *simplex)) {
            const Type* type = resolved.wantedType(tree.types());
            if (resolved.target != nullptr || type == nullptr) continue;
            const Type*& chosen = remotes[resolved.relation->target];
            if (chosen == nullptr || type->isA(chosen->name)) chosen = type;
        }
    }
    for (const auto& [path, type] : remotes) {
        SimplexInfo info;
        info.path = path;
        info.layout = layoutFor(structure, *type, true);
        info.role = type->role;
        info.remote = true;
        structure.simplexes.push_back(std::move(info));
    }
}

// Counted in 64 bit: the offsets that follow have 32.
void checkSize(const Structure& structure) {
    std::map<const TypeLayout*, std::uint64_t> octets;
    for (const auto& layout : structure.layouts) {
        std::uint64_t& size = octets[layout.get()];
        for (const DataItem& item : layout->type->data) {
            const bool string = item.kind == Kind::String;
            size += std::uint64_t{item.length} * (string ? StringCell::size(item.capacity) : 8U);
        }
    }
    std::uint64_t total = 0;
    for (const SimplexInfo& info : structure.simplexes) {
        total += octets[info.layout];
        if (total <= bounds::dataSize) continue;
        Report report;
        report.error(info.path, finding::dataSize, {},
                     "the data of the simplexes up to this one takes more than 1 GiB",
                     "shorten arrays and strings, or divide the system");
        throw ModelError{std::move(report)};
    }
}

void addEdges(Structure& structure, const SimplexTree& tree) {
    std::uint32_t owner = 0;
    for (const auto& [path, simplex] : tree.simplexes()) {
        SimplexInfo& info = structure.simplexes[owner];
        info.firstEdge = static_cast<std::uint32_t>(structure.edges.size());
        for (const auto& resolved : resolveRelations(tree, *simplex)) {
            const std::uint32_t target = structure.find(resolved.relation->target);
            if (target == noSimplex) continue;
            structure.edges.push_back(
                {owner, target, resolved.rule, resolved.delayed(), resolved.maxAge()});
        }
        info.edgeCount = static_cast<std::uint32_t>(structure.edges.size()) - info.firstEdge;
        ++owner;
    }
    structure.edges.shrink_to_fit();
}

// Who writes a descriptive simplex, and so what an instance is whose type leaves its role open.
void decideWritersAndRoles(Structure& structure) {
    for (const Edge& edge : structure.edges) {
        const SimplexInfo& owner = structure.simplexes[edge.owner];
        SimplexInfo& target = structure.simplexes[edge.target];
        if (edge.rule->direction != Direction::Output || owner.role != Role::Active) continue;
        if (target.role == Role::Active) continue;
        if (target.writers.empty() || target.writers.back() != edge.owner) {
            target.writers.push_back(edge.owner);
        }
        if (edge.delayed) target.delayedOutput = true;
    }
    for (SimplexInfo& info : structure.simplexes) {
        if (info.role != Role::Descriptive) continue;
        const bool demanded = !info.writers.empty() && !info.delayedOutput;
        info.role = demanded ? Role::Modification : Role::Observation;
    }
}

void addInitialValues(Structure& structure, const SimplexTree& tree) {
    std::uint32_t index = 0;
    for (const auto& [path, simplex] : tree.simplexes()) {
        for (const auto& setting : simplex->settings()) {
            const ItemLayout* item = structure.simplexes[index].layout->find(setting.item);
            if (item == nullptr || item->item->kind != kindOf(setting.value)) continue;
            structure.initial.push_back({index, item, setting.value});
        }
        ++index;
    }
}

void placeSlices(Structure& structure) {
    for (SimplexInfo& info : structure.simplexes) {
        info.base = structure.cyclic;
        info.constantBase = structure.constant;
        structure.cyclic += info.layout->cyclic;
        structure.constant += info.layout->constant;
    }
}

}  // namespace

std::shared_ptr<Structure> makeStructure(const std::string& agent, const SimplexTree& tree) {
    auto structure = std::make_shared<Structure>();
    structure->agent = agent;
    structure->types = tree.sharedTypes();
    addSimplexes(*structure, tree);
    addRemotes(*structure, tree);
    checkSize(*structure);
    structure->indexPaths();
    addEdges(*structure, tree);
    decideWritersAndRoles(*structure);
    placeSlices(*structure);
    addInitialValues(*structure, tree);
    return structure;
}

}  // namespace cortex
