// SPDX-License-Identifier: Apache-2.0
#include "memory_roles.hpp"

#include "cortex/core/agent.hpp"

#include "baselines/in_turn.hpp"
#include "measure/memory_probe.hpp"
#include "subject/graphs.hpp"

#include <chrono>
#include <cstdio>
#include <optional>
#include <sstream>
#include <thread>

namespace cortex::profiler {
namespace {

using namespace std::chrono_literals;

SimplexTree treeOf(const MemoryRole& role) {
    if (role.content != Content::Nothing) return Loaded::tree(role.content, role.count);
    return simplexesOf(makeEdges(Shape::Independent, static_cast<std::uint32_t>(role.count)));
}

double seconds(std::chrono::nanoseconds time) {
    return std::chrono::duration<double>(time).count();
}

}  // namespace

std::vector<std::string> wordsOf(const MemoryRole& role) {
    return {"--memory", std::to_string(static_cast<int>(role.content)), std::to_string(role.count),
            std::to_string(role.seconds), std::to_string(role.imageReaders)};
}

MemorySample sampleFrom(Child& child) {
    std::istringstream line{child.line()};
    MemorySample sample;
    line >> sample.allocated >> sample.dirty >> sample.arena >> sample.images;
    return sample;
}

int playMemoryRole(const std::vector<std::string>& words) {
    const MemoryRole role{static_cast<Content>(std::stoi(words.at(1))), std::stoi(words.at(2)),
                          std::stod(words.at(3)),
                          static_cast<std::uint32_t>(std::stoul(words.at(4)))};
    std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
    std::printf("begins\n");  // its buffer is not the cluster's
    const MemoryUse before = memoryUse();
    SimplexTree tree = treeOf(role);
    cs::ClusterCS cluster{"subject", {.imageReaders = role.imageReaders}};
    cluster.addSimplexTree(tree);
    cluster.setTriggerSource<cs::InternalClock>(1ms);
    cluster.start();
    auto due = std::chrono::steady_clock::now();
    for (int i = 0; i <= static_cast<int>(role.seconds * 10); ++i) {
        std::this_thread::sleep_until(due += 100ms);
        const MemoryUse now = memoryUse();
        std::printf("%.0f %.0f %zu %u\n", now.allocated - before.allocated,
                    now.dirty - before.dirty, cluster.agent().tables().arena().size(),
                    cluster.agent().options().imageReaders + 2U);
        if (inputEnds(0)) break;
    }
    return 0;
}

std::vector<std::string> sizeWords(int count) { return {"--size", std::to_string(count)}; }

SizeSample sizeFrom(Child& child) {
    std::istringstream line{child.line(5min)};
    SizeSample sample;
    line >> sample.adding >> sample.starting >> sample.cycle >> sample.allocated;
    return sample;
}

int playSizeRole(const std::vector<std::string>& words) {
    const MemoryUse before = memoryUse();
    std::optional<SimplexTree> tree;
    const auto adding =
        timed([&] { tree.emplace(treeOf({Content::Nothing, std::stoi(words.at(1)), 0, 8})); });
    cs::ClusterCS cluster{"subject"};
    cluster.addSimplexTree(*tree);
    auto& trigger = cluster.setTriggerSource<BurstTrigger>();
    const auto starting = timed([&] {
        cluster.start();
        trigger.burst(1);
    });
    const MemoryUse after = memoryUse();
    std::vector<Contender> cycles{
        {"cycle", [&](std::int64_t count) { return trigger.burst(count); }}};
    measureInTurn(cycles, {5, 0.1, 0});
    std::printf("%.6f %.6f %.1f %.0f\n", seconds(adding), seconds(starting), cycles[0].best(),
                after.allocated - before.allocated);
    return 0;
}

}  // namespace cortex::profiler
