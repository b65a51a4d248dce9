// SPDX-License-Identifier: Apache-2.0
#include "measured_loop.hpp"

#include "cortex/core/agent.hpp"
#include "cortex/core/error.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <utility>

#include <sched.h>
#include <sys/mman.h>

namespace cortex::profiler {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t mostSamples = 200'000;

cs::ClusterOptions clusterOptions(const RunOptions& options) {
    cs::ClusterOptions made;
    made.threads = loopThreads(options);
    made.priority = options.priority;
    made.watchdogPeriods = 1e6;
    return made;
}

// Whether a cycle comes right after the one before, with nothing of a pause in either.
bool follows(const std::vector<Recording::Cycle>& cycles, std::size_t i) {
    return i > 0 && cycles[i].block == cycles[i - 1].block && !cycles[i - 1].settling;
}

void addAll(std::vector<std::int64_t>& exact, Histogram& values, Histogram& errors) {
    if (exact.empty()) return;
    const auto middle = exact.begin() + static_cast<std::ptrdiff_t>(exact.size() / 2);
    std::nth_element(exact.begin(), middle, exact.end());
    const std::int64_t median = *middle;
    for (const std::int64_t value : exact) {
        values.add(value);
        errors.add(std::abs(value - median));
    }
}

}  // namespace

std::uint32_t loopThreads(const RunOptions& options) {
    if (options.threads != 0) return options.threads;
    cpu_set_t set;
    CPU_ZERO(&set);
    const int usable = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
    return static_cast<std::uint32_t>(std::clamp(usable, 1, 4));
}

double settlingSeconds(const RunOptions& options) {
    return options.quick || loopThreads(options) == 1 ? 0 : 1.3;
}

bool Measured::overflows() const {
    constexpr double tolerance = 0.01;  // of the ticks
    const auto share = [](std::int64_t lost, std::int64_t met) {
        return static_cast<double>(lost) / std::max(1.0, static_cast<double>(met + lost));
    };
    return duration.percentile(0.99) > period ||
           share(missed, cycles) > share(sleeperMissed, sleeps) + tolerance;
}

MeasuredLoop::MeasuredLoop(SimplexTree&& tree, std::int64_t simplexes, std::uint32_t commands,
                           double frequency, const RunOptions& options)
    : tree_{std::move(tree)},
      simplexes_{simplexes},
      commands_{commands},
      period_{std::round(1e9 / frequency)},
      cluster_{std::make_unique<cs::ClusterCS>("subject", clusterOptions(options))} {
    clock_ = &cluster_->setTriggerSource<RecordingClock>(
        std::chrono::nanoseconds{static_cast<std::int64_t>(period_)});
    cluster_->addSimplexTree(tree_);
}

MeasuredLoop::~MeasuredLoop() {
    ending_ = true;
    if (observer_.joinable()) observer_.join();
    if (cluster_->running()) shutDown();
    cluster_->stop();
    Partner::commandsPerCycle = 1;
    munlockall();  // a cluster with a priority locks all memory of the process
}

// All at once: one after the other, as stop() does it, takes a cycle each.
void MeasuredLoop::shutDown() {
    RecordingPlan rest{.loopPeriods = 5, .runIn = 0};
    rest.prepares = [this] { postToAll(cluster_->agent(), LifeCycle::Shutdown); };
    clock_->record(rest);
    while (!clock_->waitUntilDone(100ms)) continue;
}

void MeasuredLoop::start() {
    cluster_->start();
    observer_ = std::thread{[this] { observe(); }};
}

std::unique_ptr<MeasuredLoop> MeasuredLoop::ofPartners(std::int64_t simplexes,
                                                       std::uint32_t commands, double frequency,
                                                       const RunOptions& options) {
    Partner::commandsPerCycle = commands;
    TimedPartners partners = timedPartners(static_cast<int>(simplexes));
    std::unique_ptr<MeasuredLoop> loop{
        new MeasuredLoop{std::move(partners.tree), simplexes, commands, frequency, options}};
    loop->settlingPeriods_ = settlingSeconds(options) * frequency;
    loop->first_ = partners.first;
    loop->second_ = partners.second;
    loop->start();
    return loop;
}

std::unique_ptr<MeasuredLoop> MeasuredLoop::ofEmpty(std::int64_t simplexes, double frequency,
                                                    const RunOptions& options) {
    std::unique_ptr<MeasuredLoop> loop{new MeasuredLoop{
        emptySimplexes(static_cast<int>(simplexes), 1), simplexes, 0, frequency, options}};
    loop->start();
    return loop;
}

void MeasuredLoop::observe() {
    auto next = std::chrono::steady_clock::now();
    std::int64_t sum = 0;
    while (!ending_) {
        {
            const Image image = cluster_->image();
            const std::size_t all = image.structure().simplexes.size();
            for (std::uint32_t i = 0; i < all; ++i) {
                sum += static_cast<std::int64_t>(image.state(i).quality);
            }
            sum += static_cast<std::int64_t>(image.get<double>("/subject", "dutyCycleLast"));
        }
        imagesRead_ += sum >= 0 ? 1 : 0;
        std::this_thread::sleep_until(next += 33ms);
    }
}

// Loop's thread, between two cycles: no other thread of the loop counts.
void MeasuredLoop::count(Counts& counts) {
    AgentRuntime& agent = cluster_->agent();
    counts.commands = counts.rejected = 0;
    for (std::uint32_t i = 0; i < agent.threadCount(); ++i) {
        const LoopThread& thread = agent.thread(i);
        counts.commands += thread.commands;
        counts.rejected += thread.rejected;
    }
}

// What is measured of a loop whose tasks rest would say little.
void MeasuredLoop::checkActive() const {
    if (!recording().complete) return;
    if (!allActive(cluster_->image())) throw Error("not all simplexes of the loop are Active");
}

Measured MeasuredLoop::run(const RecordingPlan& plan, const std::function<bool()>& stop) {
    const auto samples = static_cast<std::size_t>(plan.blocks * (plan.loopPeriods + plan.settling));
    for (TimedPartner* each : {first_, second_}) {
        if (each != nullptr) each->prepare(std::min(samples, mostSamples));
    }
    imagesRead_ = 0;
    const auto begin = std::chrono::steady_clock::now();
    RecordingPlan whole = plan;
    whole.runIn = std::max(plan.runIn, static_cast<std::int64_t>(settlingPeriods_));
    whole.prepares = [this] { postToAll(cluster_->agent(), LifeCycle::Startup); };
    whole.begins = [this] {
        count(before_);
        if (first_ != nullptr) first_->begin();
        if (second_ != nullptr) second_->begin();
    };
    whole.ends = [this] {
        count(after_);
        if (first_ != nullptr) first_->end();
        if (second_ != nullptr) second_->end();
    };
    clock_->record(whole);
    while (!clock_->waitUntilDone(100ms)) {
        if (stop()) clock_->abandon();
    }
    checkActive();
    Measured measured;
    measured.imagesRead = imagesRead_;
    measured.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    evaluateWakes(measured);
    if (first_ != nullptr) {
        evaluateIntervals(measured);
        evaluateLatency(measured);
        evaluateCommands(measured);
    }
    return measured;
}

void MeasuredLoop::evaluateWakes(Measured& measured) const {
    const Recording& found = recording();
    const auto period = static_cast<std::int64_t>(period_);
    measured.period = period_ * 1e-3;
    measured.simplexes = simplexes_;
    measured.complete = found.complete;
    measured.sleeps = static_cast<std::int64_t>(found.sleeps.size());
    for (const Recording::Cycle& cycle : found.cycles) {
        if (cycle.settling) continue;
        ++measured.cycles;
        measured.duration.add(cycle.duration);
        measured.lateness.add(cycle.lateness);
        measured.missed += cycle.missed;
    }
    evaluateBlocks(measured);
    measured.judged = {latenessOf(found.cycles), latenessOf(found.sleeps)};
    for (std::size_t i = 0; i < found.sleeps.size(); ++i) {
        const Recording::Wake& wake = found.sleeps[i];
        measured.sleeperLateness.add(wake.lateness);
        measured.sleeperMissed += wake.missed;
        if (i == 0 || found.sleeps[i - 1].block != wake.block) continue;
        measured.sleeperIntervalError.add(std::abs(wake.at - found.sleeps[i - 1].at - period));
    }
    measured.works = std::ssize(found.works);
    for (const Recording::Cycle& work : found.works) {
        measured.workDuration.add(work.duration);
        measured.workMissed += work.missed;
    }
}

void MeasuredLoop::evaluateBlocks(Measured& measured) const {
    const auto& cycles = recording().cycles;
    for (std::size_t i = 0; i < cycles.size();) {
        Histogram block;
        const int number = cycles[i].block;
        for (; i < cycles.size() && cycles[i].block == number; ++i) {
            if (!cycles[i].settling) block.add(cycles[i].duration);
        }
        measured.blockP50.push_back(block.percentile(0.5));
        measured.blockP99.push_back(block.percentile(0.99));
    }
}

// Between executions of one task, without the pauses of the loop.
void MeasuredLoop::evaluateIntervals(Measured& measured) const {
    const Recording& found = recording();
    const auto& samples = first_->samples();
    const auto period = static_cast<std::int64_t>(period_);
    for (std::size_t i = 1; i < std::min(samples.size(), found.cycles.size()); ++i) {
        if (!follows(found.cycles, i)) continue;
        const std::int64_t interval = samples[i].begun - samples[i - 1].begun;
        measured.interval.add(interval);
        measured.intervalError.add(std::abs(interval - period));
    }
}

void MeasuredLoop::evaluateLatency(Measured& measured) const {
    const auto& first = first_->samples();
    const auto& second = second_->samples();
    const auto& cycles = recording().cycles;
    std::vector<std::int64_t> same, next;
    for (std::size_t i = 0; i < std::min({first.size(), second.size(), cycles.size()}); ++i) {
        same.push_back(second[i].begun - first[i].begun);
        measured.greatestLatencyCycles = std::max(
            {measured.greatestLatencyCycles, first[i].latencyCycles, second[i].latencyCycles});
        if (!follows(cycles, i)) continue;
        next.push_back(first[i].begun - second[i - 1].begun);
    }
    addAll(same, measured.sameCycle, measured.sameCycleError);
    addAll(next, measured.nextCycle, measured.nextCycleError);
}

void MeasuredLoop::evaluateCommands(Measured& measured) const {
    measured.commands = after_.commands - before_.commands;
    measured.rejected = after_.rejected - before_.rejected;
    measured.expectedCommands = static_cast<std::uint64_t>(recording().cycles.size()) *
                                static_cast<std::uint64_t>(simplexes_) * commands_;
    const Image image = cluster_->image();
    measured.clusterLatencyP99 = image.get<double>("/subject", "commandLatencyP99");
}

}  // namespace cortex::profiler
