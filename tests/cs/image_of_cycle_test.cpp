// SPDX-License-Identifier: Apache-2.0
#include "cortex/cs/testing.hpp"

#include "support/probe.hpp"

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::cs {
namespace {

constexpr std::uint32_t taskCount = 2000;

// Of what the tasks of a cycle wrote, on however many threads they ran.
class ImageOfCycle : public ::testing::TestWithParam<std::uint32_t> {};

// Every third one also writes a tally that both its neighbours read, so that there are two levels;
// some take long, so that threads help each other.
TEST_P(ImageOfCycle, ShowsWhatEveryTaskWroteInItsCycle) {
    std::atomic<std::int64_t> slow{0};
    test::ProbeCluster cluster{{.threads = GetParam()}};
    ClusterTesting::set(*cluster.cluster, {.forceThreads = true});
    std::vector<Data<std::int64_t>> executed(taskCount), counts(taskCount);
    std::vector<test::Probe*> probes;
    Simplex* signal = nullptr;
    for (std::uint32_t i = 0; i < taskCount; ++i) {
        test::Probe& probe = cluster.probe("/p" + std::to_string(1000 + i));
        probes.push_back(&probe);
        if (i % 3 == 1) {
            signal = &cluster.tree.add("/s" + std::to_string(1000 + i), "Tally");
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
}

TEST_P(ImageOfCycle, HasTheClusterItselfAsOldAsTheCycle) {
    test::ProbeCluster cluster{{.threads = GetParam()}};
    cluster.probe("/p");
    cluster.start();
    for (std::int64_t cycle = 1; cycle <= 3; ++cycle) {
        cluster.step();
        const Image image = cluster.cluster->image();
        const Structure& structure = image.structure();
        for (std::uint32_t i = 0; i < structure.simplexes.size(); ++i) {
            if (!structure.simplexes[i].layout->type->isA("Cluster")) continue;
            EXPECT_EQ(image.state(i).cycle, cycle);
            EXPECT_EQ(image.state(i).time, image.nominalTime());
        }
    }
}

TEST_P(ImageOfCycle, ShowsWhatATaskWroteIntoAnotherActiveSimplex) {
    test::ProbeCluster cluster{{.threads = GetParam()}};
    ClusterTesting::set(*cluster.cluster, {.forceThreads = true});
    constexpr std::uint32_t count = 600;
    std::vector<test::Probe*> probes;
    std::vector<Data<std::int64_t>> ofOther(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        probes.push_back(&cluster.probe("/p" + std::to_string(1000 + i)));
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        probes[i]->onPopulate = [&, i](test::Probe&) {
            Simplex& other = *probes[count - 1 - i];
            ofOther[i] = other.data<std::int64_t>("executed");
        };
        probes[i]->onLoopStart = [&, i](test::Probe&, const Tick& tick) {
            ofOther[i] = tick.cycle;
        };
    }
    cluster.start();
    for (std::int64_t cycle = 1; cycle <= 30; ++cycle) {
        cluster.step();
        for (const test::Probe* probe : probes) {
            ASSERT_EQ(cluster.integer(probe->path(), "executed"), cycle) << probe->path();
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Threads, ImageOfCycle, ::testing::Values(1U, 2U, 4U));

}  // namespace
}  // namespace cortex::cs
