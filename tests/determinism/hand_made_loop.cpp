// SPDX-License-Identifier: Apache-2.0
#include "determinism/hand_made_loop.hpp"

#include "cortex/core/agent.hpp"

#include "support/patience.hpp"
#include "threads/thread_pool.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

namespace cortex::determinism {

namespace {

bool hasTask(const SimplexInfo& info) { return info.layout->type->isA("Active"); }

cs::TaskGraph graphOf(const Structure& structure) {
    cs::TaskGraph graph;
    for (const SimplexInfo& info : structure.simplexes) {
        graph.nodes.push_back({info.path, hasTask(info) || info.writers.size() > 1, info.every, 0});
    }
    for (const Edge& edge : structure.edges) {
        const SimplexInfo& target = structure.simplexes[edge.target];
        if (edge.rule->direction == Direction::Output) {
            if (!edge.delayed || target.writers.size() > 1) {
                graph.edges.emplace_back(edge.owner, edge.target);
            }
        } else if (!edge.delayed && !target.delayedOutput) {
            graph.edges.emplace_back(edge.target, edge.owner);
        }
    }
    return graph;
}

SimplexTree withCluster(SimplexTree tree) {
    tree.add("/test", "Cluster");
    return tree;
}

constexpr std::uint32_t threads = 16;  // one for each chunk, so that none waits for a thread

}  // namespace

HandMadeLoop::HandMadeLoop(const Plan& plan)
    : tree_{withCluster(makeTree(plan, disturbance_))}, script_{plan} {
    AgentOptions options;
    options.extent = Extent::Part;  // random systems read what nobody writes
    options.loopThreads = threads;
    options.period = period;
    agent_ = std::make_unique<AgentRuntime>("test", tree_, options);
    const cs::TaskGraph graph = graphOf(agent_->structure());
    schedule_ = cs::makeSchedule(graph, {.threads = threads, .chunkSize = 1, .force = true});
    for (std::size_t i = 0; i < schedule_.chunks.size(); ++i) {  // nor behind another chunk
        schedule_.chunks[i].place = (static_cast<float>(i) + 0.5F) / threads;
    }
    agent_->setCanonicalOrder(schedule_.order);
    std::vector<cs::SimplexCS*> actives(graph.nodes.size());
    for (const std::uint32_t index : schedule_.order) {
        if (!hasTask(agent_->structure().simplexes[index])) continue;
        auto& task = static_cast<RandomTask&>(agent_->simplex(index));
        task.bind();
        actives[index] = &task;
    }
    agent_->addInterface(script_);
    agent_->events().addSink([this](const Event& event, const Structure& structure) {
        observation_.events.push_back(seen(event, structure));
    });
    runner_ = std::make_unique<cs::TaskRunner>(*agent_, schedule_, period);
    group_ = std::make_unique<cs::GroupCommands>(*agent_, runner_->states(),
                                                 cs::startOrder(graph, schedule_.order, actives));
    agent_->start();
}

HandMadeLoop::~HandMadeLoop() { agent_->stop(); }

bool HandMadeLoop::leadsTo(std::uint32_t from, std::uint32_t to) const {
    const cs::Chunk& chunk = schedule_.chunks[to];
    for (std::uint32_t i = 0; i < chunk.predecessorCount; ++i) {
        const std::uint32_t before = schedule_.predecessors[chunk.firstPredecessor + i];
        if (before == from || leadsTo(from, before)) return true;
    }
    return false;
}

bool HandMadeLoop::dropDependency(std::uint64_t seed) {
    Chance chance{seed};
    for (int attempt = 0; attempt < 100; ++attempt) {
        const auto number = static_cast<std::uint32_t>(chance.below(schedule_.chunks.size()));
        cs::Chunk& chunk = schedule_.chunks[number];
        if (chunk.predecessorCount == 0 || chunk.count == 0) continue;
        std::uint32_t* const first = &schedule_.predecessors[chunk.firstPredecessor];
        std::uint32_t& last = first[chunk.predecessorCount - 1];
        std::swap(first[chance.below(chunk.predecessorCount)], last);
        const std::uint32_t predecessor = last;
        if (schedule_.chunks[predecessor].count == 0) continue;
        --chunk.predecessorCount;
        if (!leadsTo(predecessor, number)) {
            dropped_ = {number, predecessor};
            return true;
        }
        ++chunk.predecessorCount;
    }
    return false;
}

void HandMadeLoop::runChunk(std::uint32_t chunk, std::uint32_t worker) {
    if (dropped_ && chunk == dropped_->predecessor) {
        const auto giveUp = std::chrono::steady_clock::now() + test::patience;
        while (ranIn_ != tick_.cycle && std::chrono::steady_clock::now() < giveUp) {
            std::this_thread::yield();
        }
    }
    runner_->run(chunk, worker);
    if (dropped_ && chunk == dropped_->chunk) ranIn_ = tick_.cycle;
}

Observation HandMadeLoop::run() {
    cs::ClusterMetrics metrics{*agent_, period, threads};
    cs::PoolOptions options;
    options.threads = threads;
    options.oversubscribe = true;
    cs::ThreadPool pool{schedule_,
                        [](void* loop, std::uint32_t chunk, std::uint32_t worker) {
                            static_cast<HandMadeLoop*>(loop)->runChunk(chunk, worker);
                        },
                        this, options};
    for (std::int64_t step = 1; step <= steps; ++step) {
        tick_ = {step, (step - 1) * period, period, period, 0};
        agent_->beginCycle(tick_);
        runner_->beginCycle(tick_);
        pool.cycle();
        metrics.write(runner_->counts(), tick_);
        agent_->endCycle(tick_, 0);
        if (step % snapshotEvery != 0) continue;
        observation_.snapshots.push_back(snapshotOf(agent_->images().newest()));
    }
    agent_->events().flush();
    observation_.answers = script_.answers();
    return observation_;
}

}  // namespace cortex::determinism
