// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/image_parts.hpp"

#include <algorithm>

namespace cortex {

namespace {

using Part = ImageParts::Part;

// Smaller ones take longer by themselves than together with the rest.
constexpr std::size_t leastOctets = 4096;

// Joins those that touch.
void join(std::vector<Part>& parts) {
    std::ranges::sort(parts, {}, &Part::offset);
    std::size_t last = 0;
    for (std::size_t i = 1; i < parts.size(); ++i) {
        if (parts[last].offset + parts[last].octets == parts[i].offset)
            parts[last].octets += parts[i].octets;
        else
            parts[++last] = parts[i];
    }
    if (!parts.empty()) parts.resize(last + 1);
}

// Where a simplex has its cells, but for texts, and its state.
void addSimplex(const Tables& tables, std::uint32_t simplex, std::vector<Part>& parts) {
    const Slice slice = tables.live(simplex);
    const BlockSizes& sizes = tables.structure().simplexes[simplex].layout->cyclic;
    const auto add = [&](const auto* cells, std::size_t count) {
        const auto* const first = reinterpret_cast<const std::byte*>(cells);
        if (count == 0) return;
        parts.push_back(
            {static_cast<std::size_t>(first - tables.arena().data()), count * sizeof(*cells)});
    };
    add(slice.floats, sizes.floats);
    add(slice.ints, sizes.ints);
    add(slice.bools, sizes.bools);
    add(slice.state, 1);
}

// What of [from, to) none of `taken` has, which ascend.
void addGaps(std::span<const Part> taken, std::size_t from, std::size_t to,
             std::vector<Part>& gaps) {
    for (const Part& part : taken) {
        const std::size_t end = part.offset + part.octets;
        if (end <= from || part.offset >= to) continue;
        if (part.offset > from) gaps.push_back({from, part.offset - from});
        from = end;
    }
    if (from < to) gaps.push_back({from, to - from});
}

}  // namespace

ImageParts divideImage(const Tables& tables,
                       std::span<const std::span<const std::uint32_t>> groups) {
    ImageParts image;
    image.ends.reserve(groups.size());
    std::vector<Part> ofGroup;
    for (const std::span<const std::uint32_t> group : groups) {
        ofGroup.clear();
        for (const std::uint32_t simplex : group) {
            const SimplexInfo& info = tables.structure().simplexes[simplex];
            if (info.role == Role::Active && !info.remote) addSimplex(tables, simplex, ofGroup);
        }
        join(ofGroup);
        std::ranges::copy_if(ofGroup, std::back_inserter(image.parts),
                             [](const Part& part) { return part.octets >= leastOctets; });
        image.ends.push_back(static_cast<std::uint32_t>(image.parts.size()));
    }
    std::vector<Part> taken = image.parts;
    join(taken);
    const auto [texts, octets] = tables.textsInArena();
    addGaps(taken, 0, texts, image.rest);
    addGaps(taken, texts + octets, tables.arena().size(), image.rest);
    return image;
}

}  // namespace cortex
