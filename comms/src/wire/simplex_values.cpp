// SPDX-License-Identifier: Apache-2.0
#include "wire/simplex_values.hpp"

#include <algorithm>
#include <array>

namespace cortex::comms {
namespace {

// Calls `visit(element, capacity, offset)` for each string of the cyclic items, in their order.
template <class Visit>
void forStrings(const TypeLayout& layout, Visit visit) {
    if (layout.cyclic.strings == 0) return;
    std::size_t element = 0;
    for (const ItemLayout& item : layout.items) {
        if (item.constant || item.item->kind != Kind::String) continue;
        const std::uint32_t capacity = item.item->capacity;
        for (std::uint32_t i = 0; i < item.item->length; ++i) {
            visit(element++, capacity, item.offset + i * StringCell::size(capacity));
        }
    }
}

std::size_t stringCount(const TypeLayout& layout) {
    std::size_t count = 0;
    forStrings(layout, [&](std::size_t, std::uint32_t, std::uint32_t) { ++count; });
    return count;
}

struct ListSize {
    const char* name;
    std::size_t came, wanted;
};

StringCell* cellAt(const Slice& slice, std::uint32_t offset) {
    return static_cast<StringCell*>(slice.at(Kind::String, offset));
}

}  // namespace

void readValues(std::uint32_t simplex, const TypeLayout& layout, const Slice& from,
                SimplexData& to) {
    const BlockSizes& sizes = layout.cyclic;
    to.index = simplex;
    to.quality = static_cast<std::uint8_t>(from.state->quality);
    to.cause = from.state->cause;
    to.cycle = from.state->cycle;
    to.time = from.state->time;
    to.ints.assign(from.ints, from.ints + sizes.ints);
    to.floats.assign(from.floats, from.floats + sizes.floats);
    to.bools.assign(from.bools, from.bools + sizes.bools);
    to.strings.resize(stringCount(layout));
    forStrings(layout, [&](std::size_t element, std::uint32_t, std::uint32_t offset) {
        to.strings[element] = cellAt(from, offset)->view();
    });
}

std::string misfit(const SimplexData& data, const TypeLayout& layout) {
    constexpr std::int64_t farthest = std::int64_t{1} << 60U;  // ns: sums do not overflow
    if (data.quality > static_cast<std::uint8_t>(Quality::Lost)) return "a quality that cannot be";
    if (data.time <= -farthest || data.time >= farthest) return "a stamp that cannot be";
    const BlockSizes& sizes = layout.cyclic;
    const std::array lists{ListSize{"ints", data.ints.size(), sizes.ints},
                           ListSize{"floats", data.floats.size(), sizes.floats},
                           ListSize{"bools", data.bools.size(), sizes.bools},
                           ListSize{"strings", data.strings.size(), stringCount(layout)}};
    for (const ListSize& each : lists) {
        if (each.came == each.wanted) continue;
        return std::to_string(each.came) + " " + each.name + " instead of " +
               std::to_string(each.wanted);
    }
    std::string wrong;
    forStrings(layout, [&](std::size_t element, std::uint32_t capacity, std::uint32_t) {
        const std::size_t octets = data.strings[element].size();
        if (octets <= capacity) return;
        wrong = "a string of " + std::to_string(octets) + " octets instead of " +
                std::to_string(capacity) + " at most";
    });
    return wrong;
}

void storeValues(const SimplexData& data, const TypeLayout& layout, const Slice& to) {
    to.state->quality = static_cast<Quality>(data.quality);
    to.state->cause = data.cause;
    to.state->cycle = data.cycle;
    to.state->time = data.time;
    std::ranges::copy(data.ints, to.ints);
    std::ranges::copy(data.floats, to.floats);
    std::ranges::copy(data.bools, to.bools);
    forStrings(layout, [&](std::size_t element, std::uint32_t, std::uint32_t offset) {
        cellAt(to, offset)->assign(data.strings[element]);
    });
}

SliceMemory::SliceMemory(const TypeLayout& layout, bool constants) {
    const BlockSizes& sizes = constants ? layout.constant : layout.cyclic;
    const auto words = [](std::size_t octets) { return (octets + 7) / 8; };
    const std::size_t ints = words(sizes.floats * sizeof(double));
    const std::size_t strings = ints + sizes.ints;
    const std::size_t bools = strings + words(sizes.strings);
    memory_.resize(bools + words(sizes.bools) + 1);
    std::uint64_t* first = memory_.data();
    slice_ = {reinterpret_cast<std::int64_t*>(first + ints), reinterpret_cast<double*>(first),
              reinterpret_cast<bool*>(first + bools), reinterpret_cast<std::byte*>(first + strings),
              &state_};
    for (const ItemLayout& item : layout.items) {
        if (item.constant != constants) continue;
        storeValue(*item.item, item.item->initial, slice_.at(item.item->kind, item.offset));
    }
}

void SliceMemory::copy(const SliceMemory& other) {
    std::ranges::copy(other.memory_, memory_.begin());
    state_ = other.state_;
}

}  // namespace cortex::comms
