// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/structure.hpp"

#include "cortex/core/data.hpp"

#include <algorithm>
#include <bit>
#include <functional>

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

}  // namespace cortex
