// SPDX-License-Identifier: Apache-2.0
#include "determinism/real_run.hpp"

#include "cortex/core/agent.hpp"
#include "cortex/core/command_exchange.hpp"
#include "cortex/core/record.hpp"
#include "cortex/cs/cluster_cs.hpp"
#include "cortex/cs/testing.hpp"

#include "support/patience.hpp"

#include <algorithm>
#include <chrono>

namespace cortex::determinism {

namespace {

constexpr std::int64_t exchangeEvery = 5 * snapshotEvery;  // cycles between two plans of the loop

}  // namespace

const TypeModel& testTypes() {
    static const TypeModel types =
        TypeModel::load(std::string{CORTEX_SOURCE_DIR} + "/tests/data/determinism-rules.xml");
    return types;
}

SimplexTree makeTree(const Plan& plan, Disturbance& disturbance) {
    SimplexTree tree{testTypes()};
    for (std::size_t i = 0; i < plan.simplexes.size(); ++i) {
        const SimplexPlan& simplex = plan.simplexes[i];
        if (!simplex.task) {
            tree.add(simplex.path, simplex.type);
            continue;
        }
        tree.add<RandomTask>(simplex.path, simplex.type, plan, i, disturbance)
            .runEvery(simplex.every, simplex.phase);
    }
    for (const SimplexPlan& simplex : plan.simplexes) {
        for (const RelationPlan& relation : simplex.relations) {
            tree.relate(tree.at(simplex.path), relation.rule, tree.at(relation.target),
                        relation.delayed);
        }
    }
    return tree;
}

Snapshot snapshotOf(const Image& image) {
    Snapshot snapshot;
    snapshot.cycle = image.cycle();
    const Structure& structure = image.structure();
    for (std::uint32_t i = 0; i < structure.simplexes.size(); ++i) {
        const TypeLayout& layout = *structure.simplexes[i].layout;
        for (const DataItem* item : comparedItems(*layout.type)) {
            const Value value = image.value(i, *layout.find(item->name));
            if (const auto* texts = std::get_if<std::vector<std::string>>(&value)) {
                for (const std::string& text : *texts) snapshot.add(text, item->capacity);
            } else if (const auto* flags = std::get_if<std::vector<bool>>(&value)) {
                for (const bool flag : *flags) snapshot.add(std::uint64_t{flag});
            } else if (const auto* numbers = std::get_if<std::vector<double>>(&value)) {
                for (const double number : *numbers) snapshot.add(number);
            } else {
                for (const std::int64_t number : std::get<0>(value)) snapshot.add(number);
            }
        }
        snapshot.add(image.state(i));
    }
    return snapshot;
}

SeenEvent seen(const Event& event, const Structure& structure) {
    const std::string path = event.simplex < structure.simplexes.size()
                                 ? structure.simplexes[event.simplex].path
                                 : std::string{};
    return {event.cycle,
            event.time,
            event.number,
            path,
            event.severity,
            event.kind,
            std::string{event.text.view()}};
}

void ScriptInterface::announce(const AgentAccess& agent) {
    for (const OutsideCommandPlan& plan : plan_.script) {
        Prepared& prepared = commands_.emplace_back();
        OutsideCommand& command = prepared.command;
        command.simplex = agent.structure->find(plan.path);
        const CommandTable table =
            commandTable(*agent.structure->simplexes[command.simplex].layout->type);
        command.command = table.find(plan.command);
        command.size = table.entries[command.command].request.size;
        command.targetEpoch = agent.structure->epoch;
        plan.sender.copy(command.sender.name.data(), plan.sender.size());
        command.sender.epoch = 1;
        auto& answered = answered_[plan.sender];
        answered.push_back(false);
        command.sequence = answered.size();
        prepared.request.resize(command.size / 8U + 1U);
        encodeRecord(table, command.command, plan.arguments,
                     reinterpret_cast<std::byte*>(prepared.request.data()));
    }
}

void ScriptInterface::read(Inbox& inbox) {
    const std::size_t first = next_;
    while (next_ < commands_.size() && plan_.script[next_].tick <= inbox.cycle()) ++next_;
    for (std::size_t i = next_; i > first; --i) {
        const Prepared& prepared = commands_[i - 1];
        OutsideCommand command = prepared.command;
        const auto& answered = answered_.find(command.sender.nameText())->second;
        const auto open = std::ranges::find(answered, false);
        command.answeredBelow = static_cast<std::uint64_t>(open - answered.begin()) + 1;
        command.notAfter = inbox.cycle() + plan_.script[i - 1].budget;
        command.request = reinterpret_cast<const std::byte*>(prepared.request.data());
        inbox.command(command);
    }
}

void ScriptInterface::write(std::int64_t cycle, Outbox& outbox) {
    OutsideAnswer answer;
    while (outbox.nextAnswer(answer)) {
        answers_.push_back({cycle, std::string{answer.sender.nameText()}, answer.sequence,
                            answer.outcome, answer.reason, std::string{answer.why.view()},
                            answer.latencyCycles});
        if (answer.outcome == Outcome::Running) continue;
        answered_.find(answer.sender.nameText())->second[answer.sequence - 1] = true;
    }
}

Observation runOnThreads(const Plan& plan, std::uint32_t threads, std::uint64_t seed) {
    Disturbance disturbance;
    disturbance.seed = seed;
    SimplexTree tree = makeTree(plan, disturbance);
    cs::ClusterOptions options;
    options.threads = threads;
    options.watchdogPeriods = 1e6;  // it measures: a busy machine is no hang
    options.imageReaders = 1;
    options.catchUpCycles = plan.catchUpCycles;
    options.overflow = plan.overflow == OverflowPlan::CatchUp ? cs::Overflow::CatchUp
                       : plan.overflow == OverflowPlan::Halt  ? cs::Overflow::Halt
                                                              : cs::Overflow::Skip;
    Observation observation;
    bool recording = true;
    cs::ClusterCS cluster{"test", options};
    cs::ClusterTesting::set(cluster, {.forceThreads = true,
                                      .chunkSize = plan.chunkSize,
                                      .endBudget = test::patience});  // nor is it at the end
    cs::ClusterTesting::judgeAsPart(cluster);  // random systems read what nobody writes
    cluster.addSimplexTree(tree);
    auto& trigger = cluster.setTriggerSource<cs::ManualTrigger>(std::chrono::nanoseconds{period});
    auto& script = cluster.addInterface<ScriptInterface>(plan);
    cluster.addEventSink([&](const Event& event, const Structure& structure) {
        if (recording) observation.events.push_back(seen(event, structure));
    });
    cluster.start();
    Chance chance{seed};
    auto late = plan.late.begin();
    for (std::int64_t done = 0; done < steps;) {
        for (; late != plan.late.end() && late->cycle == done + 1; ++late) {
            cs::ClusterTesting::playLate(trigger, late->periods);
        }
        // Up to the next look at the tables, or to the step that is late.
        std::int64_t until = (done / snapshotEvery + 1) * snapshotEvery;
        if (late != plan.late.end()) until = std::min(until, late->cycle - 1);
        trigger.step(until - done);
        done = until;
        if (done % snapshotEvery != 0) continue;
        observation.snapshots.push_back(snapshotOf(cluster.image()));
        if (threads == 1 || done % exchangeEvery != 0) continue;
        const auto others = static_cast<std::uint32_t>(1 + chance.below(threads));
        const auto chunkSize = static_cast<std::uint32_t>(chance.below(5));
        observation.plansOffered += cs::ClusterTesting::offerPlan(cluster, others, chunkSize);
    }
    cluster.agent().events().flush();
    recording = false;
    observation.answers = script.answers();
    cluster.stop();
    observation.commandsExecuted = disturbance.executed;
    observation.commandsAcross = disturbance.across;
    return observation;
}

}  // namespace cortex::determinism
