// SPDX-License-Identifier: Apache-2.0
#include "wire/simplex_marks.hpp"

#include "cortex/core/labelled_value.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <type_traits>

namespace cortex::comms {
namespace {

constexpr unsigned qualityBits = 0x3U, stateBits = 0x7U, stateShift = 2U, outsideBit = 0x20U;

template <class T>
bool isElementOutside(const DataItem& item, T element) {
    const cortex::Number number{element};
    if ((item.min && number < *item.min) || (item.max && *item.max < number)) return true;
    if constexpr (std::is_same_v<T, std::int64_t>) {
        return isClosed(item) && !item.labels.contains(element);
    }
    return false;
}

bool isAnyOutside(const ItemLayout& each, const Slice& slice) {
    for (std::uint32_t i = 0; i < each.item->length; ++i) {
        if (isOutside(each, slice, i)) return true;
    }
    return false;
}

}  // namespace

bool isLimited(const ItemLayout& each) {
    const DataItem& item = *each.item;
    const bool number = item.kind == Kind::Int || item.kind == Kind::Float;
    return number && !each.constant && (item.min || item.max || isClosed(item));
}

bool isOutside(const ItemLayout& each, const Slice& slice, std::uint32_t element) {
    const DataItem& item = *each.item;
    if (item.kind == Kind::Int) return isElementOutside(item, slice.ints[each.offset + element]);
    return isElementOutside(item, slice.floats[each.offset + element]);
}

std::uint8_t octetOf(const SimplexMark& mark) {
    const unsigned state = mark.state ? static_cast<unsigned>(*mark.state) + 1 : 0;
    return static_cast<std::uint8_t>(static_cast<unsigned>(mark.quality) | state << stateShift |
                                     (mark.outside ? outsideBit : 0U));
}

std::optional<SimplexMark> markOf(std::uint8_t octet) {
    const unsigned state = octet >> stateShift & stateBits;
    if (state > stateCount) return {};
    SimplexMark mark;
    mark.quality = static_cast<Quality>(octet & qualityBits);
    if (state != 0) mark.state = static_cast<State>(state - 1);
    mark.outside = (octet & outsideBit) != 0;
    return mark;
}

SimplexMarks::SimplexMarks(const Structure& structure) {
    std::map<const TypeLayout*, std::uint32_t> places;
    for (const SimplexInfo& info : structure.simplexes) {
        const auto place = static_cast<std::uint32_t>(layouts_.size());
        const auto [found, isNew] = places.try_emplace(info.layout, place);
        looked_.push_back(found->second);
        if (!isNew) continue;
        Looked& looked = layouts_.emplace_back();
        if (info.layout->type->active()) looked.state = info.layout->find("state");
        if (looked.state != nullptr && looked.state->item->kind != Kind::Int)
            looked.state = nullptr;
        for (const ItemLayout& each : info.layout->items) {
            if (isLimited(each)) looked.limited.push_back(&each);
        }
    }
}

SimplexMark SimplexMarks::of(std::uint32_t simplex, const Slice& slice) const {
    const Looked& looked = layouts_[looked_[simplex]];
    SimplexMark mark;
    mark.quality = slice.state->quality;
    if (looked.state != nullptr) {
        const std::int64_t state = slice.ints[looked.state->offset];
        if (state >= 0 && state < stateCount) mark.state = static_cast<State>(state);
    }
    mark.outside = mark.quality == Quality::Good &&
                   std::ranges::any_of(looked.limited, [&](const ItemLayout* each) {
                       return isAnyOutside(*each, slice);
                   });
    return mark;
}

}  // namespace cortex::comms
