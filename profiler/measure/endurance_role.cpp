// SPDX-License-Identifier: Apache-2.0
#include "endurance_role.hpp"

#include "cortex/comms/dds_interface.hpp"
#include "cortex/core/agent.hpp"
#include "cortex/cs/testing.hpp"

#include "measure/allocation_count.hpp"
#include "measure/comms_domain.hpp"
#include "measure/memory_probe.hpp"
#include "subject/echo.hpp"
#include "subject/graphs.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <sstream>
#include <thread>

namespace cortex::profiler {
namespace {

// From nothing to 20 us in each cycle and back, in 20 s; of ten every other one against the others.
class Varying final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;
    double phase = 0;

private:
    void populate() override { work(0); }
    void loopStart(const Tick& tick) override {
        const double angle = 2 * std::numbers::pi * (tick.seconds() / 20 + phase);
        work(10'000 * (1 + std::sin(angle)));
    }
};

SimplexTree enduringTree() {
    SimplexTree tree{subjectTypes()};
    for (int i = 0; i < 100; ++i) tree.add("/items/n" + std::to_string(i), "TenItems");
    for (int i = 0; i < 10; ++i) {
        tree.add<Varying>("/load/n" + std::to_string(i), "Empty").phase = i % 2 * 0.5;
    }
    tree.add<Echo>("/echo", "Partner");
    return tree;
}

}  // namespace

std::vector<std::string> wordsOf(const EnduranceRole& role) {
    return {"--endure", std::to_string(role.domain), std::to_string(role.threads),
            std::to_string(role.frequency), std::to_string(role.priority)};
}

EnduranceSample enduranceFrom(Child& child) {
    std::istringstream line{child.line()};
    EnduranceSample now;
    line >> now.time >> now.allocated >> now.resident >> now.proportional >> now.dirty >>
        now.handles >> now.threads >> now.loopAllocations >> now.cycles >> now.tables;
    return now;
}

int playEnduranceRole(const std::vector<std::string>& words) {
    cs::ClusterOptions options;
    options.threads = static_cast<std::uint32_t>(std::stoul(words.at(2)));
    options.priority = std::stoi(words.at(4));
    SimplexTree tree = enduringTree();
    cs::ClusterCS cluster{"subject", options};
    cs::ClusterTesting::set(cluster, {.onThreadStart = [](std::uint32_t /*thread*/) {
                                countAllocationsOfThisThread();
                            }});
    cluster.addSimplexTree(tree);
    cluster.setTriggerSource<cs::InternalClock>(
        std::chrono::nanoseconds{static_cast<std::int64_t>(1e9 / std::stod(words.at(3)))});
    cluster.addInterface<comms::DdsInterface>(loopback(std::stoi(words.at(1))));
    cluster.start();
    std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
    std::printf("runs\n");
    const std::uint64_t before = countedAllocations();
    const auto begin = std::chrono::steady_clock::now();
    auto due = begin;
    while (!inputEnds(0)) {
        std::this_thread::sleep_until(due += std::chrono::seconds{1});
        const std::chrono::duration<double> time = due - begin;
        const MemoryUse now = memoryUse();
        const Image image = cluster.image();
        std::printf("%.0f %.0f %.0f %.0f %.0f %d %d %llu %lld %zu\n", time.count(), now.allocated,
                    now.resident, now.proportional, now.dirty, openHandles(), runningThreads(),
                    static_cast<unsigned long long>(countedAllocations() - before),
                    static_cast<long long>(image.cycle()), cluster.agent().tables().arena().size());
    }
    return 0;
}

}  // namespace cortex::profiler
