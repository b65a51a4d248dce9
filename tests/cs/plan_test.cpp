// SPDX-License-Identifier: Apache-2.0
#include "loop/plan.hpp"

#include "support/probe.hpp"
#include "support/small_structure.hpp"

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::cs {
namespace {

constexpr std::uint32_t taskCount = 2000;

std::shared_ptr<const Structure> makePumps(std::uint32_t count = taskCount) {
    test::SmallStructure made;
    const Type& pump = made.type("Pump", Role::Active, {test::item("flow", std::vector{0.0})});
    for (std::uint32_t i = 0; i < count; ++i) {
        made.add("/p" + std::to_string(10000 + i), pump);
    }
    return made.build();
}

Schedule scheduleOf(const Structure& structure, std::uint32_t threads) {
    TaskGraph graph;
    for (const SimplexInfo& info : structure.simplexes) graph.nodes.push_back({info.path, true});
    return makeSchedule(graph, {.threads = threads, .force = true});
}

TEST(Plan, GroupsTheChunksOfEachThreadToCopyTheirPartOfTheImage) {
    const auto structure = makePumps();
    const Tables tables{structure};
    const Schedule schedule = scheduleOf(*structure, 2);
    const ImageGroups image = groupImage(tables, schedule);

    ASSERT_EQ(image.parts.ends.size(), 2U);
    ASSERT_EQ(image.ofChunk.size(), schedule.chunks.size());
    for (std::size_t i = 0; i < schedule.chunks.size(); ++i) {
        EXPECT_EQ(image.ofChunk[i], homeOf(schedule.chunks[i], 2)) << i;
    }
    for (const std::uint32_t group : {0U, 1U}) {
        ASSERT_EQ(image.parts.of(group).size(), 2U);  // numbers and states
        EXPECT_NEAR(static_cast<double>(image.parts.of(group)[0].octets),
                    taskCount / 2 * sizeof(double), 1000);
    }
}

TEST(Plan, BeginsAnotherGroupBeforeOneIsMoreThanTheCachesHold) {
    const auto structure = makePumps(5 * taskCount);
    const Tables tables{structure};
    const ImageGroups image = groupImage(tables, scheduleOf(*structure, 2));

    EXPECT_EQ(image.parts.ends.size(), 4U);
}

TEST(Plan, LeavesTheImageToTheEndOfTheCycleWhereOneThreadDoesAll) {
    const auto structure = makePumps();
    const Tables tables{structure};
    const ImageGroups image = groupImage(tables, scheduleOf(*structure, 1));

    EXPECT_TRUE(image.ofChunk.empty());
    EXPECT_TRUE(image.parts.parts.empty());
}

TEST(Plan, LeavesToTheEndOfTheCycleWhatIsTooLittleToCopyByItself) {
    const auto structure = makePumps(100);
    const Tables tables{structure};
    const ImageGroups image = groupImage(tables, scheduleOf(*structure, 2));

    EXPECT_TRUE(image.ofChunk.empty());
    EXPECT_TRUE(image.parts.parts.empty());
}

class SharedImage : public ::testing::TestWithParam<std::uint32_t> {};

// Every third one also writes a signal that both its neighbours read, so that there are two levels;
// some take long, so that threads help each other.
TEST_P(SharedImage, ShowsWhatEveryTaskWroteInItsCycle) {
    std::atomic<std::int64_t> slow{0};
    test::ProbeCluster cluster{{.threads = GetParam(), .forceThreads = true}};
    std::vector<Data<std::int64_t>> executed(taskCount), counts(taskCount);
    std::vector<test::Probe*> probes;
    Simplex* signal = nullptr;
    for (std::uint32_t i = 0; i < taskCount; ++i) {
        test::Probe& probe = cluster.probe("/p" + std::to_string(1000 + i));
        probes.push_back(&probe);
        if (i % 3 == 1) {
            signal = &cluster.tree.add("/s" + std::to_string(1000 + i), "Signal");
            cluster.tree.relate(probe, "out", *signal);
            cluster.tree.relate(*probes[i - 1], "in", *signal);
        } else if (i % 3 == 2) {
            cluster.tree.relate(probe, "in", *signal);
        }
        probe.onPopulate = [&, i](test::Probe& self) {
            executed[i] = self.data<std::int64_t>("executed");
            if (i % 3 == 1) counts[i] = self.output("out").data<std::int64_t>("count");
        };
        probe.onLoopStart = [&, i](test::Probe&, const Tick& tick) {
            executed[i] = tick.cycle;
            if (i % 3 == 1) counts[i] = tick.cycle;
            for (int k = 0; i % 500 == tick.cycle % 500 && k < 20'000; ++k) ++slow;
        };
    }
    cluster.start();
    std::uint32_t late = 0;
    for (std::int64_t cycle = 1; cycle <= 30; ++cycle) {
        cluster.step();
        const Image image = cluster.cluster->image();
        ASSERT_EQ(image.cycle(), cycle);
        const Structure& structure = image.structure();
        for (std::uint32_t i = 0; i < structure.simplexes.size(); ++i) {
            const TypeLayout& layout = *structure.simplexes[i].layout;
            const ItemLayout* item = layout.find("executed");
            if (item == nullptr) item = layout.find("count");
            if (item == nullptr) continue;  // the cluster
            const std::int64_t seen = image.slice(i).ints[item->offset];
            if (seen != cycle || image.state(i).cycle != cycle) ++late;
        }
    }
    EXPECT_EQ(late, 0U);
    EXPECT_EQ(probes[0]->runtime().images().isDivided(), GetParam() > 1);
}

INSTANTIATE_TEST_SUITE_P(Threads, SharedImage, ::testing::Values(1U, 2U, 4U));

}  // namespace
}  // namespace cortex::cs
