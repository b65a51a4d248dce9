// SPDX-License-Identifier: Apache-2.0
// Does a loop notice who watches it? The lateness of a loop of 10,000 items at 1 kHz, in turn with
// a bare sleeper: alone, with many processes that look at everything (all but one at 30 Hz, one at
// every cycle), and with as many that send a command a second.
#include "measure/observers.hpp"

#include "cortex/comms/dds_interface.hpp"

#include "measure/comms_domain.hpp"
#include "observers/alternating_clock.hpp"
#include "observers/client.hpp"
#include "subject/echo.hpp"
#include "subject/subject.hpp"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <sys/resource.h>

namespace cortex::profiler {
namespace {

using observers::AlternatingClock;
using observers::Clients;
using observers::Load;

struct Part {
    const char *id, *what;
    double from;  // of the measurement
};
constexpr Part alone{"alone", "nobody watches", 0}, watched{"watched", "watched", 1.0 / 3},
    commanded{"commanded", "commanded", 2.0 / 3};

int partSeconds(const RunOptions& options) { return options.quick ? 8 : 120; }
int clientCount(const RunOptions& options) { return options.quick ? 10 : 50; }

SimplexTree observedTree() {
    SimplexTree tree{subjectTypes()};
    for (int i = 0; i < 1000; ++i) tree.add("/items/n" + std::to_string(i), "TenItems");
    tree.add<Echo>("/echo", "Partner");
    return tree;
}

double cpuSeconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
           static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec) * 1e-6;
}

// Of one part: what compares it with the others.
struct Found {
    double ratio = 0, nullRatio = 1;
};

class Observation {
public:
    Observation(const RunOptions& options, Progress& progress, Results& results)
        : options_{options},
          progress_{progress},
          results_{results},
          tree_{observedTree()},
          cluster_{"subject", {.priority = 80, .watchdogPeriods = 1e6}} {
        cluster_.addSimplexTree(tree_);
        clock_ = &cluster_.setTriggerSource<AlternatingClock>();
        cluster_.addInterface<comms::DdsInterface>(loopback(domain_));
        cluster_.start();
        for (const std::string& refusal : cluster_.realtimeReport()) {
            results_.notes.push_back("observers: " + refusal);
        }
        figure_.setup = std::to_string(clientCount(options)) + " processes, " +
                        measurementDomain().text() + "; p99 of each second.";
    }

    // Whole or none: none if told to stop.
    std::optional<Found> measure(const Part& part);
    std::optional<Found> measureWith(const Part& part, Load first, Load others, const char* counts);
    void judge(const Part& part, const Found& with, const Found& without);
    void finish() { results_.figures.push_back(std::move(figure_)); }

private:
    void add(const Part& part, const AlternatingClock::Measured& measured, double cpu);
    void addLine(const std::string& name, const observers::Lateness& lateness, bool baseline);

    const RunOptions& options_;
    Progress& progress_;
    Results& results_;
    const int domain_ = measurementDomain().number;
    SimplexTree tree_;
    cs::ClusterCS cluster_;
    AlternatingClock* clock_ = nullptr;
    Figure figure_{.id = "observers",
                   .title = "Lateness of a loop that is watched",
                   .paper = "",
                   .setup = "",
                   .x = {"seconds measured", "s", false},
                   .y = {"p99 of lateness", "us", true},
                   .series = {},
                   .marks = {}};
};

std::optional<Found> Observation::measure(const Part& part) {
    std::this_thread::sleep_for(std::chrono::seconds{2});
    clock_->take();
    const double before = cpuSeconds();
    for (int second = 0; second < partSeconds(options_); ++second) {
        const double done = part.from + second / 3.0 / partSeconds(options_);
        if (!progress_.step(done, part.what)) return std::nullopt;
        std::this_thread::sleep_for(std::chrono::seconds{1});
    }
    const double cpu = (cpuSeconds() - before) / partSeconds(options_);
    const AlternatingClock::Measured measured = clock_->take();
    add(part, measured, cpu);
    const double sleeper = std::max(measured.sleeper.medianOfP99(), 1e-3);
    return Found{measured.loop.medianOfP99() / sleeper, measured.sleeper.nullRatio()};
}

std::optional<Found> Observation::measureWith(const Part& part, Load first, Load others,
                                              const char* counts) {
    Clients clients;
    for (int i = 0; i < clientCount(options_); ++i) {
        clients.start(i, i == 0 ? first : others, domain_);
    }
    clients.waitUntilReady();
    const auto begin = std::chrono::steady_clock::now();
    const std::optional<Found> found = measure(part);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    const std::vector<std::uint64_t> all = clients.stop();
    const double sum = static_cast<double>(std::accumulate(all.begin(), all.end(), 0ULL));
    results_.quantities.push_back({.id = std::string{"observers/"} + part.id + "/rate",
                                   .what = std::string{counts} + " per second and client",
                                   .unit = "1/s",
                                   .value = sum / static_cast<double>(all.size()) / time.count(),
                                   .lessIsBetter = false});
    return found;
}

void Observation::add(const Part& part, const AlternatingClock::Measured& measured, double cpu) {
    const std::string id = std::string{"observers/"} + part.id;
    const std::string what = std::string{part.what} + ": ";
    results_.quantities.push_back(
        {.id = id + "/lateness",
         .what = what + "median of the seconds' p99 of lateness; " + measured.loop.tail(),
         .unit = "us",
         .value = measured.loop.medianOfP99(),
         .repeats = measured.loop.p99s(),
         .baseline = measured.sleeper.medianOfP99(),
         .baselineName = "bare sleeper; " + measured.sleeper.tail()});
    results_.quantities.push_back({.id = id + "/missed",
                                   .what = what + "ticks that the loop missed",
                                   .unit = "ticks",
                                   .value = static_cast<double>(measured.missed),
                                   .baseline = static_cast<double>(measured.missedBySleeper),
                                   .baselineName = "bare sleeper"});
    results_.quantities.push_back({.id = id + "/cpu",
                                   .what = what + "CPU that the process took",
                                   .unit = "%",
                                   .value = 100 * cpu});
    addLine(std::string{part.what} + ", loop", measured.loop, false);
    addLine(std::string{part.what} + ", bare sleeper", measured.sleeper, true);
}

void Observation::addLine(const std::string& name, const observers::Lateness& lateness,
                          bool baseline) {
    Series series{name, {}, baseline};
    double second = 0;
    for (const double p99 : lateness.p99s()) series.points.push_back({second++, p99});
    figure_.series.push_back(std::move(series));
}

void Observation::judge(const Part& part, const Found& with, const Found& without) {
    const double limit = std::max({1.2, with.nullRatio, without.nullRatio});
    results_.quantities.push_back(
        {.id = std::string{"observers/"} + part.id + "/change",
         .what = std::string{"change of the ratio to the bare sleeper when "} + part.what +
                 "; beyond 1.3 the sleeper differed from itself so much: too noisy",
         .unit = "ratio",
         .value = with.ratio / without.ratio,
         .aim = Aim::AtMost,
         .limit = limit});
}

double seconds(const RunOptions& options) {
    return 3 * (partSeconds(options) + 2) + 0.5 * clientCount(options);
}

void run(const RunOptions& options, Progress& progress, Results& results) {
    Observation observation{options, progress, results};
    const auto before = observation.measure(alone);
    const auto with = before ? observation.measureWith(watched, Load::ViewEvery, Load::View30,
                                                       "images that were seen")
                             : std::nullopt;
    if (with) observation.judge(watched, *with, *before);
    const auto told = with ? observation.measureWith(commanded, Load::Command, Load::Command,
                                                     "commands that were done")
                           : std::nullopt;
    if (told) observation.judge(commanded, *told, *before);
    if (before) observation.finish();
}

}  // namespace

const Measurement& observersMeasurement() {
    static constexpr Measurement measurement{
        "observers", "whether a loop notices 50 tools that watch or command it", seconds, run};
    return measurement;
}

}  // namespace cortex::profiler
