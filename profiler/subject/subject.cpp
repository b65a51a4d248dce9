// SPDX-License-Identifier: Apache-2.0
#include "subject.hpp"

#include "cortex/core/agent.hpp"
#include "cortex/core/clock.hpp"
#include "cortex/core/error.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace cortex::profiler {

std::chrono::nanoseconds BurstTrigger::burst(std::int64_t cycles) {
    const std::int64_t target = executed_.load() + cycles;
    wanted_.store(target);
    wanted_.notify_all();
    for (std::int64_t executed = executed_.load(); executed < target; executed = executed_.load()) {
        executed_.wait(executed);
    }
    return end_ - begin_;
}

cs::Trigger BurstTrigger::waitForTick() {
    const bool ends = cycle_ >= 0 && cycle_ + 1 == wanted_.load(std::memory_order_relaxed);
    if (ends) {
        end_ = std::chrono::steady_clock::now();
        executed_.store(cycle_ + 1);
        executed_.notify_all();
    }
    while (cycle_ + 1 >= wanted_.load(std::memory_order_relaxed)) {
        if (interrupted_.load()) return {.stopped = true};
        wanted_.wait(cycle_ + 1);
    }
    // Also where the next burst was asked for before this waited.
    if (ends || cycle_ < 0) begin_ = std::chrono::steady_clock::now();
    ++cycle_;
    return {.nominalTime = cycle_ * period(), .stopped = interrupted_.load()};
}

void BurstTrigger::interrupt() {
    interrupted_.store(true);
    wanted_.fetch_add(1);
    wanted_.notify_all();
}

void Partner::populate() {
    on<&Partner::ping>("ping");
    asked_ = argument<double>("ping", "number");
    answered_ = result<double>("ping", "number");
    for (const char* rule : {"after", "late"}) {
        for (OutputSimplex& partner : outputs(rule)) {
            ping_ = partner.command("ping", 2 * commandsPerCycle);
            number_ = ping_.argument<double>("number");
        }
    }
}

void WorkingPartner::populate() {
    Partner::populate();
    level_ = data<double>("level");
    OutputSimplex demand = output("demand");
    position_ = demand.data<double>("position");
    velocity_ = demand.data<double>("velocity");
}

void WorkingPartner::stateActive(const Tick& tick) {
    level_ = static_cast<double>(tick.cycle % 1000) * 1e-3;
    position_ = level_;
    velocity_ = -level_;
}

void Partner::loopStart(const Tick& tick) {
    number_ = static_cast<double>(tick.cycle);
    for (std::uint32_t i = 0; i < commandsPerCycle; ++i) {
        if (ping_.send() != Outcome::None) ++full;
    }
}

Outcome Partner::ping(Call& call) {
    call[answered_] = static_cast<double>(call[asked_]);
    ++executed;
    return Outcome::Done;
}

void TimedPartner::loopStart(const Tick& tick) {
    if (recording_ && samples_.size() < samples_.capacity()) {
        samples_.push_back({monotonicNow(), newestAnswer().latencyCycles});
    }
    Partner::loopStart(tick);
}

SubjectCluster::SubjectCluster(SimplexTree&& simplexes, cs::ClusterOptions options)
    : tree{std::move(simplexes)}, cluster{"subject", std::move(options)} {
    cluster.addSimplexTree(tree);
    trigger = &cluster.setTriggerSource<BurstTrigger>();
    cluster.start();
    trigger->burst(1);
    postToAll(cluster.agent(), LifeCycle::Startup);
    trigger->burst(100);
    if (!allActive(cluster.image())) throw Error("not all simplexes of the cluster are Active");
}

void postToAll(AgentRuntime& agent, LifeCycle command) {
    const auto& all = agent.structure().simplexes;
    for (std::uint32_t i = 0; i < all.size(); ++i) {
        if (!all[i].layout->type->isA("Active")) continue;
        agent.postLifeCycle(i, command, false);
    }
}

bool allActive(const Image& image) {
    const auto& all = image.structure().simplexes;
    return std::ranges::all_of(all, [&](const SimplexInfo& info) {
        return !info.layout->type->isA("Active") || image.get<std::int64_t>(info.path, "state") ==
                                                        static_cast<std::int64_t>(State::Active);
    });
}

TypeModel subjectTypes() {
    return TypeModel::load(std::string{CORTEX_SOURCE_DIR} + "/profiler/subject/subject-rules.xml");
}

SimplexTree emptySimplexes(int count, int chain) {
    SimplexTree tree{subjectTypes()};
    Simplex* last = nullptr;
    for (int i = 0; i < count; ++i) {
        Simplex& simplex = tree.add<Empty>("/s" + std::to_string(i), "Empty");
        if (i % chain != 0) tree.relate(simplex, "before", *last);
        last = &simplex;
    }
    return tree;
}

namespace {

template <class T>
std::pair<T*, T*> addPair(SimplexTree& tree, int number, const char* type) {
    T& first = tree.add<T>("/p" + std::to_string(number), type);
    T& second = tree.add<T>("/p" + std::to_string(number + 1), type);
    tree.relate(first, "after", second);
    tree.relate(second, "late", first);
    return {&first, &second};
}

}  // namespace

SimplexTree partners(int count) {
    SimplexTree tree{subjectTypes()};
    for (int i = 0; i + 1 < count; i += 2) addPair<Partner>(tree, i, "Partner");
    return tree;
}

TimedPartners timedPartners(int count) {
    TimedPartners made{SimplexTree{subjectTypes()}, nullptr, nullptr};
    const int middle = count / 4 * 2;
    // Numbers of one length, so that partners stand side by side, as in a plant.
    const int start = 1'000'000;
    for (int i = 0; i + 1 < count; i += 2) {
        if (i != middle)
            addPair<WorkingPartner>(made.tree, start + i, "WorkingPartner");
        else
            std::tie(made.first, made.second) =
                addPair<TimedPartner>(made.tree, start + i, "WorkingPartner");
    }
    return made;
}

}  // namespace cortex::profiler
