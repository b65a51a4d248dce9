// SPDX-License-Identifier: Apache-2.0
// Does a loop notice who watches it, and do they see it? The lateness of a loop of 10,000 items at
// 1 kHz, in turn with a bare sleeper: alone, and with many processes that look at everything, all
// but one at 30 Hz, one at every cycle.
#include "cortex/comms/dds_interface.hpp"
#include "cortex/core/agent.hpp"
#include "cortex/core/error.hpp"
#include "cortex/cs/testing.hpp"

#include "measure/allocation_count.hpp"
#include "measure/client.hpp"
#include "measure/comms_domain.hpp"
#include "measure/measurements.hpp"
#include "measure/recording_clock.hpp"
#include "measure/sweep.hpp"
#include "report/judging.hpp"
#include "report/number_text.hpp"
#include "subject/subject.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cortex::profiler {
namespace {

using namespace std::chrono_literals;

constexpr std::int64_t cyclesPerSecond = 1000;  // cycles
constexpr int itemSimplexes = 1000;             // of ten items
constexpr double viewRate = 30, seen = 0.9;     // part of the images that is to be seen

int blocks(const RunOptions& options) { return options.quick ? 5 : 60; }  // of 2 s
int clientCount(const RunOptions& options) { return options.quick ? 10 : 50; }

// Writes one item of each of its outputs in each cycle.
class Feeder final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override {
        for (OutputSimplex& each : outputs("feeds")) items_.push_back(each.data<double>("f0"));
    }
    void stateActive(const Tick& tick) override {
        for (Data<double>& item : items_) item = static_cast<double>(tick.cycle);
    }
    std::vector<Data<double>> items_;
};

SimplexTree observedTree() {
    SimplexTree tree{subjectTypes()};
    Simplex& feeder = tree.add<Feeder>("/feeder", "Feeder");
    for (int i = 0; i < itemSimplexes; ++i) {
        tree.relate(feeder, "feeds", tree.add("/items/n" + std::to_string(i), "TenItems"));
    }
    return tree;
}

class Observation {
public:
    Observation(const RunOptions& options, Progress& progress, Results& results);
    ~Observation() { clock_->abandon(); }

    void runOn();  // at 1 kHz, until measure() takes over
    // None if told to stop.
    std::optional<LoopAndSleeper> measure(const std::string& name, double from);
    std::optional<LoopAndSleeper> measureWatched();
    void finish() { results_.figures.push_back(std::move(figure_)); }

private:
    void add(const std::string& name, const LoopAndSleeper& found);
    void addSeen(std::vector<std::unique_ptr<Child>>& clients);
    double loopSeconds() const;

    const RunOptions& options_;
    Progress& progress_;
    Results& results_;
    const int domain_ = measurementDomain().number;
    SimplexTree tree_ = observedTree();
    cs::ClusterCS cluster_;
    RecordingClock* clock_ = nullptr;
    Figure figure_{.id = "observers",
                   .title = "Lateness of a loop that is watched",
                   .paper = "",
                   .setup = "",
                   .x = {"seconds measured", "s", false},
                   .y = {"p99 of lateness", "us", true},
                   .series = {},
                   .marks = {}};
};

Observation::Observation(const RunOptions& options, Progress& progress, Results& results)
    : options_{options},
      progress_{progress},
      results_{results},
      cluster_{"subject", {.priority = options.priority, .watchdogPeriods = 1e6}} {
    cs::ClusterTesting::set(cluster_, {.onThreadStart = [](std::uint32_t /*thread*/) {
                                countAllocationsOfThisThread();
                            }});
    cluster_.addSimplexTree(tree_);
    clock_ = &cluster_.setTriggerSource<RecordingClock>(1ms);
    cluster_.addInterface<comms::DdsInterface>(loopback(domain_));
    cluster_.start();
    noteRefusals(cluster_.realtimeReport(), results_);
    figure_.setup =
        "10,000 items without limits, one Active simplex writes 1,000 of them in each "
        "cycle; " +
        std::to_string(clientCount(options)) + " processes watch, " + measurementDomain().text() +
        "; " + std::to_string(blocks(options)) +
        " s of the loop and of a bare sleeper in turn, p99 of each second.";
}

void Observation::runOn() {
    RecordingPlan plan;
    plan.runIn = 3600 * cyclesPerSecond;
    plan.prepares = [this] { postToAll(cluster_.agent(), LifeCycle::Startup); };
    clock_->record(plan);
}

std::optional<LoopAndSleeper> Observation::measure(const std::string& name, double from) {
    clock_->abandon();
    while (!clock_->waitUntilDone(100ms)) continue;
    RecordingPlan plan{blocks(options_), cyclesPerSecond, cyclesPerSecond};
    plan.runIn = cyclesPerSecond;
    std::uint64_t before = 0, after = 0;
    plan.prepares = [this] { postToAll(cluster_.agent(), LifeCycle::Startup); };
    plan.begins = [&] { before = countedAllocations(); };
    plan.ends = [&] { after = countedAllocations(); };
    clock_->record(plan);
    const auto begin = std::chrono::steady_clock::now();
    while (!clock_->waitUntilDone(500ms)) {
        const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
        if (progress_.step(from + time.count() / (5.0 * blocks(options_)), name)) continue;
        clock_->abandon();
    }
    const Recording& found = clock_->recording();
    if (!found.complete) return std::nullopt;
    if (!allActive(cluster_.image())) throw Error("the loop that is watched is not Active");
    LoopAndSleeper judged{latenessOf(found.cycles), latenessOf(found.sleeps)};
    add(name, judged);
    results_
        .add("observers/" + name + "/allocations",
             name + ": allocator calls of the loop's threads in " +
                 readable(static_cast<double>(found.cycles.size())) + " cycles",
             "calls", static_cast<double>(after - before))
        .atMost(0)
        .inPaper("0 over two minutes");
    return judged;
}

double Observation::loopSeconds() const {
    return static_cast<double>(clock_->recording().cycles.size()) / cyclesPerSecond;
}

std::optional<LoopAndSleeper> Observation::measureWatched() {
    runOn();
    std::vector<std::unique_ptr<Child>> clients;
    for (int i = 0; i < clientCount(options_); ++i) {
        clients.push_back(std::make_unique<Child>(
            clientWords(i, i == 0 ? 0 : static_cast<int>(viewRate), domain_)));
    }
    for (const auto& each : clients) {
        if (!progress_.step(0.4, "those who watch join")) return std::nullopt;
        if (each->line(150s) != "ready") throw Error("a client found nothing to look at");
    }
    for (const auto& each : clients) each->say("begin");
    const auto found = measure("watched", 0.5);
    for (const auto& each : clients) each->end();
    if (found) addSeen(clients);
    return found;
}

void Observation::add(const std::string& name, const LoopAndSleeper& found) {
    results_
        .add("observers/" + name + "/lateness", name + ": median of the seconds' p99 of lateness",
             "us", found.loop.typical())
        .ofRepeats(found.loop.p99s)
        .beside(found.sleeper.typical(), "bare sleeper");
    const auto addLine = [&](const char* of, const std::vector<double>& p99s, bool baseline) {
        Series line{name + ", " + of, {}, baseline};
        for (const double p99 : p99s) {
            line.points.push_back({static_cast<double>(line.points.size()), p99});
        }
        figure_.series.push_back(std::move(line));
    };
    addLine("loop", found.loop.p99s, false);
    addLine("bare sleeper", found.sleeper.p99s, true);
}

// The first sees every cycle. The run-in of a second is seen, too.
void Observation::addSeen(std::vector<std::unique_ptr<Child>>& clients) {
    double every = 0, least = 1e9, whole = 1;
    for (const auto& each : clients) {
        const ClientSample sample = sampleOf(*each);
        const double rate = static_cast<double>(sample.images) / (loopSeconds() + 1);
        (each == clients.front() ? every : least) =
            each == clients.front() ? rate : std::min(least, rate);
        whole = std::min(whole, static_cast<double>(sample.whole) /
                                    std::max(1.0, static_cast<double>(sample.images)));
    }
    const auto addAim = [&](const char* id, const char* what, const char* unit, double value,
                            double limit) {
        results_.add(std::string{"observers/"} + id, what, unit, value).atLeast(limit);
    };
    addAim("images/30", "images of a second of the loop that the worst tool at 30 Hz sees", "1/s",
           least, seen * viewRate);
    addAim("images/every", "images of a second of the loop that the tool at every cycle sees",
           "1/s", every, seen * cyclesPerSecond);
    addAim("whole", "images with all simplexes, of one cycle, the worst of all tools", "%",
           100 * whole, 100);
}

double observersSeconds(const RunOptions& options) {
    return 2 * (2 * blocks(options) + 1) + 0.5 * clientCount(options);
}

void runObservers(const RunOptions& options, Progress& progress, Results& results) {
    Observation observation{options, progress, results};
    observation.runOn();
    const auto alone = observation.measure("alone", 0);
    const auto watched = alone ? observation.measureWatched() : std::nullopt;
    if (watched) {
        Quantity change = judgedChange(*watched, *alone);
        change.id = "observers/change";
        change.what = "change of the ratio to the bare sleeper when " +
                      std::to_string(clientCount(options)) + " tools watch";
        results.quantities.push_back(std::move(change));
    }
    if (alone) observation.finish();
}

}  // namespace

Measurement observersMeasurement() {
    return {"observers", "whether a loop notices 50 tools that watch it, and what they see",
            "Observers", observersSeconds, runObservers};
}

}  // namespace cortex::profiler
