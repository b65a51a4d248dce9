// SPDX-License-Identifier: Apache-2.0
#include "loop/plan.hpp"

#include <span>

namespace cortex::cs {

namespace {

// 2,000 tasks with a command each write so much, and touch what a second-level cache of 1 MB holds.
constexpr std::size_t octetsInGroup = 96 * 1024;

std::size_t octetsOf(const Tables& tables, std::uint32_t simplex) {
    const BlockSizes& sizes = tables.structure().simplexes[simplex].layout->cyclic;
    return sizes.floats * sizeof(double) + sizes.ints * sizeof(std::int64_t) +
           sizes.bools * sizeof(bool) + sizeof(SlotState);
}

}  // namespace

ImageGroups groupImage(const Tables& tables, const Schedule& schedule) {
    if (schedule.threads < 2) return {{}, divideImage(tables, {})};
    ImageGroups image;
    std::vector<std::vector<std::uint32_t>> tasks;
    std::vector<std::size_t> octets;
    std::vector<std::uint32_t> open(schedule.threads, noGroup);  // by thread
    for (const Chunk& chunk : schedule.chunks) {
        std::uint32_t& group = open[homeOf(chunk, schedule.threads)];
        if (group == noGroup || octets[group] >= octetsInGroup) {
            group = static_cast<std::uint32_t>(tasks.size());
            tasks.emplace_back();
            octets.push_back(0);
        }
        const auto of = std::span{schedule.tasks}.subspan(chunk.first, chunk.count);
        tasks[group].insert(tasks[group].end(), of.begin(), of.end());
        for (const std::uint32_t simplex : of) octets[group] += octetsOf(tables, simplex);
        image.ofChunk.push_back(group);
    }
    image.parts = divideImage(
        tables, std::vector<std::span<const std::uint32_t>>{tasks.begin(), tasks.end()});
    for (std::uint32_t& group : image.ofChunk) {
        if (image.parts.of(group).empty()) group = noGroup;
    }
    if (image.parts.parts.empty()) image.ofChunk.clear();
    return image;
}

}  // namespace cortex::cs
