// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/structure.hpp"

#include "cortex/core/agent.hpp"
#include "cortex/core/data.hpp"
#include "cortex/core/error.hpp"

#include "base/bounds.hpp"
#include "base/system_findings.hpp"
#include "model/resolved_relations.hpp"

#include <algorithm>
#include <bit>
#include <functional>
#include <map>
#include <utility>

namespace cortex {
namespace {

std::uint32_t& countOf(BlockSizes& sizes, Kind kind) {
    switch (kind) {
        case Kind::Int:
            return sizes.ints;
        case Kind::Float:
            return sizes.floats;
        case Kind::Bool:
            return sizes.bools;
        case Kind::String:
            break;
    }
    return sizes.strings;
}

std::uint32_t elements(const DataItem& item) {
    return item.kind == Kind::String ? item.length * StringCell::size(item.capacity) : item.length;
}

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
            structure.edges.push_back({owner, target, resolved.rule, resolved.delayed()});
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

BlockSizes& BlockSizes::operator+=(const BlockSizes& other) {
    ints += other.ints;
    floats += other.floats;
    bools += other.bools;
    strings += other.strings;
    return *this;
}

TypeLayout typeLayout(const Type& type, bool remote) {
    TypeLayout layout;
    layout.type = &type;
    layout.remote = remote;
    for (const auto& item : type.data) {
        const bool constant = item.constant && !remote;
        std::uint32_t& used = countOf(constant ? layout.constant : layout.cyclic, item.kind);
        layout.items.push_back({&item, used, constant});
        used += elements(item);
    }
    return layout;
}

const ItemLayout* TypeLayout::find(std::string_view item) const {
    const auto found = std::ranges::lower_bound(
        items, item, {},
        [](const ItemLayout& each) -> std::string_view { return each.item->name; });
    return found != items.end() && found->item->name == item ? &*found : nullptr;
}

const ItemLayout* RecordLayout::find(std::string_view parameter) const {
    const auto found = std::ranges::find_if(
        items, [&](const ItemLayout& each) { return each.item->name == parameter; });
    return found != items.end() ? &*found : nullptr;
}

RecordLayout recordLayout(const std::vector<DataItem>& parameters) {
    RecordLayout layout;
    for (const auto& parameter : parameters) {
        layout.items.push_back({&parameter, layout.size});
        const bool octets = parameter.kind == Kind::Bool || parameter.kind == Kind::String;
        const std::uint32_t size = elements(parameter) * (octets ? 1U : 8U);
        layout.size += (size + 7U) / 8U * 8U;
    }
    return layout;
}

// Open addressing, at most half full; of equal paths the first is found.
void Structure::indexPaths() {
    pathTable.assign(std::bit_ceil(2 * simplexes.size() + 1), noSimplex);
    const std::size_t mask = pathTable.size() - 1;
    for (std::uint32_t index = 0; index < simplexes.size(); ++index) {
        std::size_t place = std::hash<std::string_view>{}(simplexes[index].path) & mask;
        while (pathTable[place] != noSimplex) place = (place + 1) & mask;
        pathTable[place] = index;
    }
}

std::uint32_t Structure::find(std::string_view path) const {
    if (pathTable.empty()) return noSimplex;
    const std::size_t mask = pathTable.size() - 1;
    std::size_t place = std::hash<std::string_view>{}(path)&mask;
    while (pathTable[place] != noSimplex && simplexes[pathTable[place]].path != path) {
        place = (place + 1) & mask;
    }
    return pathTable[place];
}

std::uint32_t Structure::writtenEvery(std::uint32_t simplex) const {
    const SimplexInfo& info = simplexes[simplex];
    if (info.role == Role::Active) return info.every;
    std::uint32_t every = 1;
    for (const std::uint32_t writer : info.writers) {
        every = std::max(every, simplexes[writer].every);
    }
    return every;
}

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
