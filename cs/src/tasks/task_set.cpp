// SPDX-License-Identifier: Apache-2.0
#include "tasks/task_set.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/framework_item.hpp"

#include "tasks/task_demands.hpp"

#include <algorithm>
#include <cmath>
#include <ranges>

namespace cortex::cs {

namespace {

std::int64_t toNanoseconds(double seconds) { return std::llround(seconds * 1e9); }

}  // namespace

// Fills a TaskSet from the frozen structure; setup only.
struct TaskBuilder {
    TaskSet& set;
    AgentRuntime& agent;
    const Structure& structure;
    std::vector<DemandLimits*> limitsOf;  // per simplex
    std::vector<std::vector<Arbiter::Candidate>> candidates;
    struct RunEnds {
        std::size_t floats = 0, ints = 0, labels = 0, texts = 0;
    };
    std::vector<RunEnds> runEnds;  // per task

    const TypeLayout& layout(std::uint32_t simplex) const {
        return *structure.simplexes[simplex].layout;
    }
    std::span<const Edge> edgesOf(std::uint32_t simplex) const {
        const SimplexInfo& info = structure.simplexes[simplex];
        return std::span{structure.edges}.subspan(info.firstEdge, info.edgeCount);
    }
    std::uint32_t numberOf(const Edge& edge) const {
        return static_cast<std::uint32_t>(&edge - structure.edges.data());
    }
    bool isDemand(std::uint32_t simplex) const {
        const SimplexInfo& info = structure.simplexes[simplex];
        return info.role == Role::Modification && !info.writers.empty();
    }
    bool isActive(std::uint32_t simplex) const {
        return structure.simplexes[simplex].role == Role::Active;
    }

    bool isDevice(std::uint32_t simplex) const {
        return isActive(simplex) && layout(simplex).type->isA("Device");
    }
    bool measures(std::uint32_t simplex) const { return layout(simplex).type->measures; }

    // What a device says of its link, if its type has such an item (ontology/devices.xml).
    DemandTaker takerOf(std::uint32_t device) const {
        DemandTaker taker{device, &set.states[device], nullptr, 0};
        const ItemLayout* link = layout(device).find("link");
        if (link == nullptr || link->item->kind != Kind::Int) return taker;
        for (const auto& [number, label] : link->item->labels) {
            if (label != "Open") continue;
            taker.link = static_cast<const std::int64_t*>(
                agent.tables().live(device).at(Kind::Int, link->offset));
            taker.open = number;
        }
        return taker;
    }
    // The devices of this agent that read a demand in the cycle that writes it.
    void addTakers() {
        std::vector<std::vector<DemandTaker>> takers(structure.simplexes.size());
        for (const Edge& edge : structure.edges) {
            const bool takes = edge.rule->direction == Direction::Input && !edge.delayed &&
                               limitsOf[edge.target] != nullptr && isDevice(edge.owner);
            if (takes) takers[edge.target].push_back(takerOf(edge.owner));
        }
        for (std::uint32_t i = 0; i < takers.size(); ++i) {
            if (!takers[i].empty())
                limitsOf[i]->setTakers(std::move(takers[i]), agent.tables().taken(i));
        }
    }

    void build(const Schedule& schedule) {
        limitsOf.assign(structure.simplexes.size(), nullptr);
        candidates.resize(structure.simplexes.size());
        std::size_t inputs = 0, outputs = 0;
        for (const Edge& edge : structure.edges) {
            const bool isInput = edge.rule->direction == Direction::Input;
            if (isInput)
                ++inputs;
            else if (!isActive(edge.target))
                ++outputs;
        }
        set.inputs.reserve(inputs);
        set.outputs.reserve(outputs);  // pointers to elements are kept
        agent.tables().latch();
        for (std::uint32_t i = 0; i < structure.simplexes.size(); ++i) {
            if (!isDemand(i)) continue;
            set.limits.push_back(std::make_unique<DemandLimits>(layout(i), agent.tables().live(i),
                                                                agent.tables().acceptedCopy(i), i));
            limitsOf[i] = set.limits.back().get();
        }
        addTakers();
        set.tasks.resize(schedule.tasks.size());
        set.details.resize(schedule.tasks.size());
        set.runsOf.resize(schedule.tasks.size());
        runEnds.resize(schedule.tasks.size());
        for (std::size_t t = 0; t < schedule.tasks.size(); ++t) {
            const std::uint32_t index = schedule.tasks[t];
            if (isActive(index)) buildTask(set.tasks[t], index);
        }
        for (std::size_t t = 0; t < schedule.tasks.size(); ++t) {
            const std::uint32_t index = schedule.tasks[t];
            if (!isActive(index)) buildArbiter(set.tasks[t], index);
        }
        shareRuns();
        for (const auto& limits : set.limits) limits->accept();
        agent.tables().latch();
    }

    // Each task gets its part of the runs, now that they stay where they are.
    void shareRuns() {
        RunEnds before;
        for (std::size_t t = 0; t < set.tasks.size(); ++t) {
            if (set.tasks[t].simplex == nullptr) continue;
            const auto [floats, ints, labels, texts] = runEnds[t];
            set.runsOf[t] = {
                std::span{set.runs.floats}.subspan(before.floats, floats - before.floats),
                std::span{set.runs.ints}.subspan(before.ints, ints - before.ints),
                std::span{set.runs.labels}.subspan(before.labels, labels - before.labels),
                std::span{set.runs.texts}.subspan(before.texts, texts - before.texts)};
            before = runEnds[t];
        }
    }

    void buildTask(Task& task, std::uint32_t index) {
        const SimplexInfo& info = structure.simplexes[index];
        auto& simplex = static_cast<SimplexCS&>(agent.simplex(index));
        task.simplex = &simplex;
        task.index = index;
        task.everyCycle = info.every == 1;
        task.measures = info.layout->type->measures;
        TaskDetails& details = set.detailsOf(task);
        details.every = info.every;
        details.phase = info.phase >= 0 ? static_cast<std::uint32_t>(info.phase) % info.every
                                        : agent.rank(index) % info.every;
        details.lastRun = -static_cast<std::int64_t>(info.every) * set.period +
                          static_cast<std::int64_t>(details.phase) * set.period;
        details.state = frameworkItem<std::int64_t>(agent, index, "state");
        details.faultCode = frameworkItem<std::int64_t>(agent, index, "faultCode");
        details.faultText = frameworkItem<std::string_view>(agent, index, "faultText");
        details.taskTime = frameworkItem<double>(agent, index, "taskTime");
        set.states[index] = {0, 0, index, Quality::Stale};
        task.firstInput = static_cast<std::uint32_t>(set.inputs.size());
        task.firstOutput = static_cast<std::uint32_t>(set.outputs.size());
        for (const Edge& edge : edgesOf(index)) {
            if (edge.rule->direction == Direction::Input)
                addInput(edge);
            else if (!isActive(edge.target))
                addOutput(task, edge, simplex);
        }
        details.checks = checksOf(agent.tables().live(index), index);
        if (details.checks != nullptr) task.values = Task::Values::ToPass;
        runEnds[static_cast<std::size_t>(&task - set.tasks.data())] = {
            set.runs.floats.size(), set.runs.ints.size(), set.runs.labels.size(),
            set.runs.texts.size()};
        task.inputCount = static_cast<std::uint32_t>(set.inputs.size()) - task.firstInput;
        task.outputCount = static_cast<std::uint32_t>(set.outputs.size()) - task.firstOutput;
    }

    void addInput(const Edge& edge) {
        const SimplexInfo& target = structure.simplexes[edge.target];
        const std::uint32_t number = numberOf(edge);
        TaskInput input;
        input.rule = edge.rule;
        input.target = edge.target;
        input.ages = target.remote || target.role == Role::Active || !target.writers.empty();
        input.maxAge = std::max(toNanoseconds(edge.maxAge),
                                3 * set.period * structure.writtenEvery(edge.target));
        input.fromOutside = target.remote || measures(edge.target) ||
                            std::ranges::any_of(target.writers, [this](std::uint32_t writer) {
                                return measures(writer);
                            });
        if (target.remote) {
            input.ownerPeriod = &agent.ownerPeriod(edge.target);
            input.linkLosses = &agent.linkLosses(edge.target);
        }
        input.state = agent.tables().edgeSource(number).state;
        const bool isSetPoint =
            target.role == Role::Modification && target.writers.empty() && !target.remote;
        if (isSetPoint && isDevice(edge.owner)) {
            set.setPoints.push_back(
                {edge.target, static_cast<const SimplexCS*>(&agent.simplex(edge.owner))});
        }
        if (edge.rule->onLoss == OnLoss::Hold) {
            set.held.push_back(std::make_unique<HeldInput>(
                HeldInput{target.layout->cyclic, agent.tables().edgeSource(number),
                          agent.tables().edge(number)}));
            input.held = set.held.back().get();
        }
        set.inputs.push_back(input);
    }

    // Null: nothing of it could be wrong.
    ValueChecks* checksOf(const Slice& values, std::uint32_t simplex) {
        auto checks = std::make_unique<ValueChecks>(*structure.types, layout(simplex), values,
                                                    simplex, set.runs);
        if (checks->empty()) return nullptr;
        set.checks.push_back(std::move(checks));
        return set.checks.back().get();
    }

    void addOutput(Task& task, const Edge& edge, SimplexCS& writer) {
        TaskOutput output;
        output.target = edge.target;
        const Slice out = agent.tables().edge(numberOf(edge));
        output.state = out.state;
        const bool shared = structure.simplexes[edge.target].writers.size() > 1;
        if (isDemand(edge.target)) {
            const auto [observedLayout, observed] = counterpart(edge);
            set.safe.push_back(std::make_unique<SafeDemands>(
                layout(edge.target), out, *limitsOf[edge.target], observedLayout, observed));
            output.safe = set.safe.back().get();
            output.standsSafe = true;
            *out.state = ofSafeDemand(task.index, {});  // its writer may run much later
            task.demands = Task::Demands::Bound;
            if (!shared) output.limits = limitsOf[edge.target];
        } else {
            output.checks = checksOf(out, edge.target);
        }
        set.outputs.push_back(output);
        if (shared) {
            candidates[edge.target].push_back(
                {&writer, out, &set.outputs.back(), &set.detailsOf(task).stateSince});
        }
        if (output.checks != nullptr) task.values = Task::Values::ToPass;
    }

    // What observes the n-th demand: the n-th relationship under the counterpart rule, or its only.
    std::pair<const TypeLayout*, Slice> counterpart(const Edge& output) const {
        if (output.rule->counterpart.empty()) return {nullptr, {}};
        std::size_t position = 0;
        std::vector<const Edge*> observing;
        for (const Edge& edge : edgesOf(output.owner)) {
            if (edge.rule == output.rule && &edge < &output) ++position;
            if (edge.rule->name == output.rule->counterpart) observing.push_back(&edge);
        }
        if (observing.empty()) return {nullptr, {}};
        const Edge& edge = *observing[position < observing.size() ? position : 0];
        return {&layout(edge.target), agent.tables().edgeSource(numberOf(edge))};
    }

    void buildArbiter(Task& task, std::uint32_t index) {
        auto arbiter = std::make_unique<Arbiter>();
        arbiter->target = index;
        arbiter->sizes = layout(index).cyclic;
        arbiter->live = agent.tables().live(index);
        arbiter->limits = limitsOf[index];
        arbiter->candidates = candidates[index];
        std::ranges::sort(arbiter->candidates, {}, [&](const Arbiter::Candidate& candidate) {
            return agent.rank(candidate.writer->index());
        });
        if (!arbiter->candidates.empty()) {
            copySlice(arbiter->sizes, arbiter->candidates.front().slice, arbiter->live);
        }
        task.index = index;
        set.detailsOf(task).arbiter = arbiter.get();
        set.arbiters.push_back(std::move(arbiter));
    }
};

TaskSet::TaskSet(AgentRuntime& runtime, const Schedule& schedule, std::int64_t nominalPeriod)
    : agent{runtime},
      structure{runtime.structure()},
      states{runtime.tables().states().data()},
      period{nominalPeriod},
      threads(runtime.threadCount()) {
    for (std::uint32_t i = 0; i < agent.threadCount(); ++i) threads[i].loop = &agent.thread(i);
    TaskBuilder{*this, agent, structure, {}, {}, {}}.build(schedule);
}

}  // namespace cortex::cs
