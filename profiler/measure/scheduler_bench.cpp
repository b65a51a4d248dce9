// SPDX-License-Identifier: Apache-2.0
#include "scheduler_bench.hpp"

#include "threads/realtime_thread.hpp"

#include <map>
#include <optional>

#include <oneapi/tbb/task_arena.h>

namespace cortex::profiler {
namespace {

SimplexTree withAgent(SimplexTree tree) {
    tree.add("/bench", "Cluster");
    return tree;
}

AgentOptions optionsFor(std::uint32_t threads) {
    AgentOptions options;
    options.loopThreads = threads;
    return options;
}

// Of a task of a flow graph: which of its threads runs it.
std::uint32_t arenaThread() {
    return static_cast<std::uint32_t>(oneapi::tbb::this_task_arena::current_thread_index());
}

}  // namespace

SchedulerBench::SchedulerBench(const TaskEdges& edges, std::uint32_t threads)
    : tree_{withAgent(simplexesOf(edges))}, agent_{"bench", tree_, optionsFor(threads)} {
    cs::TaskGraph graph;
    for (const SimplexInfo& info : agent_.structure().simplexes) {
        graph.nodes.push_back({info.path, info.layout->type->isA("Active"), 1, 0});
    }
    for (const Edge& edge : agent_.structure().edges) {
        graph.edges.emplace_back(edge.target, edge.owner);
    }
    agent_.setCanonicalOrder(cs::canonicalOrder(graph));
    schedule_ = cs::makeSchedule(graph, {});
    runner_ = std::make_unique<cs::TaskRunner>(agent_, schedule_, 1'000'000);
    std::map<std::uint32_t, std::uint32_t> slotOf;
    for (std::uint32_t i = 0; i < schedule_.tasks.size(); ++i) slotOf[schedule_.tasks[i]] = i;
    for (std::uint32_t i = 0; i < edges.count; ++i) {
        slots_.push_back(slotOf.at(agent_.structure().find(taskPath(i))));
    }
    agent_.start();
    if (threads > 1) {  // as a cluster does once it knows what its tasks cost
        const std::vector<double> costs(graph.nodes.size(), microsecondsOfTask());
        schedule_ = cs::makeSchedule(graph, {.threads = threads, .costMicroseconds = costs});
        runner_->use(schedule_);
    }
    pool_ = std::make_unique<cs::ThreadPool>(
        schedule_,
        [](void* runner, std::uint32_t chunk, std::uint32_t worker) {
            static_cast<cs::TaskRunner*>(runner)->run(chunk, worker);
        },
        runner_.get(), cs::PoolOptions{});
}

double SchedulerBench::microsecondsOfTask() {
    constexpr std::int64_t cycles = 100;
    plainly(cycles);  // whatever has not been touched yet
    const std::chrono::duration<double, std::micro> time = plainly(cycles);
    return time.count() / static_cast<double>(cycles * static_cast<std::int64_t>(slots_.size()));
}

SchedulerBench::~SchedulerBench() {
    pool_.reset();
    agent_.stop();
}

void SchedulerBench::beginCycle() {
    ++tick_.cycle;
    tick_.nominalTime += 1'000'000;
    runner_->beginCycle(tick_);
}

std::chrono::nanoseconds SchedulerBench::cycles(std::int64_t count) {
    // Where threads share work a cluster pins them, its loop's own too.
    std::optional<cs::OnCpu> pinned;
    if (pool_->threads() > 1) pinned.emplace(cs::cpuForThread({}, 0));
    return timed([&] {
        for (std::int64_t i = 0; i < count; ++i) {
            beginCycle();
            pool_->cycle();
        }
    });
}

std::chrono::nanoseconds SchedulerBench::plainly(std::int64_t count) {
    const auto tasks = static_cast<std::uint32_t>(slots_.size());
    return timed([&] {
        for (std::int64_t i = 0; i < count; ++i) {
            beginCycle();
            for (std::uint32_t each = 0; each < tasks; ++each) runner_->runAlone(each, 0);
        }
    });
}

TaskFunction SchedulerBench::task() {
    return {[](void* context, std::uint32_t task) {
                auto& self = *static_cast<SchedulerBench*>(context);
                const std::uint32_t worker = self.agent_.threadCount() == 1 ? 0 : arenaThread();
                self.runner_->runAlone(self.slots_[task], worker);
            },
            this};
}

std::uint32_t usableCpus() {
    static const auto count = static_cast<std::uint32_t>(cs::usableCpus().size());
    return count;
}

}  // namespace cortex::profiler
