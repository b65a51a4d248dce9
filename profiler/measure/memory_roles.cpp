// SPDX-License-Identifier: Apache-2.0
#include "memory_roles.hpp"

#include "cortex/core/agent.hpp"
#include "cortex/cs/testing.hpp"

#include "measure/allocation_count.hpp"
#include "subject/graphs.hpp"

#include <chrono>
#include <cstdio>
#include <sstream>
#include <thread>

#include <malloc.h>

namespace cortex::profiler {
namespace {

using namespace std::chrono_literals;
// In bytes, by malloc and not given back, mappings of its own included; allocates nothing itself.
double allocated() {
    const struct mallinfo2 info = mallinfo2();
    return static_cast<double>(info.uordblks + info.hblkhd);
}

SimplexTree treeOf(const MemoryRole& role) {
    if (role.content != Content::Nothing) return Loaded::tree(role.content, role.count);
    return simplexesOf(makeEdges(Shape::Independent, static_cast<std::uint32_t>(role.count)));
}

}  // namespace

std::vector<std::string> wordsOf(const MemoryRole& role) {
    return {"--memory", std::to_string(static_cast<int>(role.content)), std::to_string(role.count),
            std::to_string(role.seconds), std::to_string(role.imageReaders)};
}

MemorySample sampleFrom(Child& child) {
    std::istringstream line{child.line()};
    MemorySample sample;
    line >> sample.allocated >> sample.arena >> sample.images >> sample.allocations;
    return sample;
}

int playMemoryRole(const std::vector<std::string>& words) {
    const MemoryRole role{static_cast<Content>(std::stoi(words.at(1))), std::stoi(words.at(2)),
                          std::stod(words.at(3)),
                          static_cast<std::uint32_t>(std::stoul(words.at(4)))};
    std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
    std::printf("begins\n");  // its buffer is not the cluster's
    const double before = allocated();
    SimplexTree tree = treeOf(role);
    cs::ClusterOptions options{.imageReaders = role.imageReaders};
    cs::ClusterCS cluster{"subject", options};
    cs::ClusterTesting::set(cluster, {.onThreadStart = [](std::uint32_t /*thread*/) {
                                countAllocationsOfThisThread();
                            }});
    cluster.addSimplexTree(tree);
    cluster.setTriggerSource<cs::InternalClock>(1ms);
    cluster.start();
    auto due = std::chrono::steady_clock::now();
    for (int i = 0; i <= static_cast<int>(role.seconds * 10); ++i) {
        std::this_thread::sleep_until(due += 100ms);
        std::printf("%.0f %zu %u %llu\n", allocated() - before,
                    cluster.agent().tables().arena().size(),
                    cluster.agent().options().imageReaders + 2U,
                    static_cast<unsigned long long>(countedAllocations()));
        if (inputEnds(0)) break;
    }
    return 0;
}

}  // namespace cortex::profiler
