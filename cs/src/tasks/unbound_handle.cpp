// SPDX-License-Identifier: Apache-2.0
#include "tasks/unbound_handle.hpp"

#include "cortex/core/tables.hpp"

#include <cstddef>
#include <cstring>
#include <span>
#include <string_view>

namespace cortex::cs {

namespace {

constexpr std::size_t faultTextCapacity = 48;  // of the item in base.xml

// The item of one simplex whose cells begin at `cell`; empty if none does.
std::string_view itemIn(const TypeLayout& layout, const Slice& cyclic, const Slice& constants,
                        const void* cell) {
    for (const ItemLayout& item : layout.items) {
        const Slice& slice = item.constant ? constants : cyclic;
        if (slice.at(item.item->kind, item.offset) == cell) return item.item->name;
    }
    return {};
}

// Of what the simplex may touch: its own items, and those of what it is related to.
std::string_view itemAt(const void* cell, std::uint32_t simplex, const Tables& tables) {
    const Structure& structure = tables.structure();
    const SimplexInfo& info = structure.simplexes[simplex];
    const std::string_view own =
        itemIn(*info.layout, tables.live(simplex), tables.constants(simplex), cell);
    if (!own.empty()) return own;
    for (std::uint32_t edge = info.firstEdge; edge < info.firstEdge + info.edgeCount; ++edge) {
        const std::uint32_t target = structure.edges[edge].target;
        const std::string_view item = itemIn(*structure.simplexes[target].layout, tables.seen(edge),
                                             tables.constants(target), cell);
        if (!item.empty()) return item;
        const Slice accepted = tables.acceptedCopy(target);
        if (accepted.state == nullptr) continue;
        const std::string_view read =
            itemIn(*structure.simplexes[target].layout, accepted, tables.constants(target), cell);
        if (!read.empty()) return read;
    }
    return {};
}

}  // namespace

EventText neighboursOf(const UnboundHandle& unbound, const SimplexCS& simplex,
                       const Tables& tables) {
    constexpr std::ptrdiff_t handleSize = sizeof(void*), farthest = 64 * handleSize;
    const std::span<const std::byte> object = simplex.object();
    const std::ptrdiff_t size = std::ssize(object);
    const std::ptrdiff_t place = static_cast<const std::byte*>(unbound.at()) - object.data();
    if (object.empty() || place < 0 || place >= size) return {};
    const auto nearest = [&](std::ptrdiff_t step) -> std::string_view {
        for (std::ptrdiff_t at = place + step; at >= 0 && at + handleSize <= size; at += step) {
            if (at - place > farthest || place - at > farthest) break;
            const void* cell = nullptr;
            std::memcpy(static_cast<void*>(&cell), object.data() + at, sizeof cell);
            if (cell == nullptr) continue;
            const std::string_view item = itemAt(cell, simplex.index(), tables);
            if (!item.empty()) return item;
        }
        return {};
    };
    const std::string_view before = nearest(-handleSize), after = nearest(handleSize);
    EventText text;
    if (!before.empty() && !after.empty())
        text << " between those of '" << before << "' and '" << after << "'";
    else if (!before.empty())
        text << " after that of '" << before << "'";
    else if (!after.empty())
        text << " before that of '" << after << "'";
    return text;
}

EventText textOf(const UnboundHandle& unbound, const SimplexCS& simplex, const Tables& tables,
                 Hook hook) {
    EventText text{"handle "};
    text << unbound.handle() << neighboursOf(unbound, simplex, tables).view()
         << " is not bound (forgotten in populate()?); used in " << name(hook) << " of "
         << simplex.type().name;
    return text;
}

EventText briefOf(const UnboundHandle& unbound, Hook hook) {
    EventText text{"unbound "};
    text << unbound.handle() << " in " << name(hook);
    if (text.view().size() <= faultTextCapacity) return text;
    text = "unbound handle in ";
    return text << name(hook);
}

}  // namespace cortex::cs
