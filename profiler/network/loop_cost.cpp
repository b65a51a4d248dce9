// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agent.hpp"

#include "figures.hpp"
#include "measure/client.hpp"
#include "plant.hpp"
#include "roles.hpp"

#include <chrono>
#include <memory>
#include <thread>

namespace cortex::profiler {
namespace {

using namespace std::chrono_literals;

Plant::Options subject(const CommsRun& run, int items) {
    return {.name = "subject",
            .samples = items / itemsPerSample,
            .network = loopback(run.domain),
            .cluster = {.priority = 80, .watchdogPeriods = 1e6}};
}

std::vector<std::int64_t> record(Plant& plant, int seconds) {
    plant.network.record();
    std::this_thread::sleep_for(std::chrono::seconds{seconds});
    return plant.network.take();
}

void add(const CommsRun& run, const std::string& id, const std::string& what,
         const std::vector<std::int64_t>& costs) {
    addTimes(run,
             {.id = "comms/loop/" + id,
              .what = "read() and write() of the network in a cycle: " + what,
              .unit = "us",
              .aim = Aim::AtMost,
              .limit = 5},
             costs);
}

// No network: what the stopwatch itself takes.
void withoutNetwork(const CommsRun& run) {
    run.step(0, "the stopwatch itself");
    Plant::Options none = subject(run, 100);
    none.network.reset();
    Plant plant{none};
    plant.cluster.setTriggerSource<cs::InternalClock>(1ms);
    plant.start();
    for (const std::string& refusal : plant.cluster.realtimeReport()) {
        run.results.notes.push_back("comms: " + refusal);
    }
    addTimes(
        run,
        {.id = "comms/loop/stopwatch", .what = "no network: the stopwatch itself", .unit = "us"},
        record(plant, run.seconds));
}

Series withReaders(const CommsRun& run, int items) {
    const std::string many = std::to_string(items) + " items";
    Series series{many, {}, false};
    Plant plant{subject(run, items)};
    plant.cluster.setTriggerSource<cs::InternalClock>(1ms);
    plant.start();
    std::vector<std::unique_ptr<Child>> readers;
    for (const std::size_t count : {0U, 1U, 4U}) {
        const std::string number = std::to_string(count);
        run.step(0.05, many + ", " + number + " readers");
        while (readers.size() < count) {
            readers.push_back(std::make_unique<Child>(
                clientWords(static_cast<int>(readers.size()), 0, run.domain)));
        }
        for (std::size_t i = count == 4 ? 1 : 0; i < readers.size(); ++i) readers[i]->line();
        const std::vector<std::int64_t> costs = record(plant, run.seconds);
        add(run, std::to_string(items) + "/" + number,
            many + ", " + number + " readers of every cycle", costs);
        series.points.push_back({static_cast<double>(count), medianMicroseconds(costs)});
    }
    return series;
}

void withLinks(const CommsRun& run, int items) {
    const int samples = items / itemsPerSample;
    const std::string what = std::to_string(items) + " items of another agent linked";
    run.step(0.25, what);
    const Child owner{agentWords("owner", run.domain, samples)};
    Plant::Options linking = subject(run, itemsPerSample);
    linking.links = samplePaths("owner", samples);
    Plant plant{linking};
    plant.cluster.setTriggerSource<cs::InternalClock>(1ms);
    plant.start();
    while (!plant.linked()) std::this_thread::sleep_for(1ms);
    add(run, "links/" + std::to_string(items), what, record(plant, run.seconds));
}

}  // namespace

void measureLoopCost(const CommsRun& run) {
    withoutNetwork(run);
    Figure figure{.id = "comms-loop-cost",
                  .title = "What the network costs the loop",
                  .paper = "",
                  .setup =
                      "Median of read() and write() in each cycle of 1 ms; readers "
                      "are processes that look at everything in every cycle.",
                  .x = {"readers", "", false},
                  .y = {"time in a cycle", "us", false},
                  .series = {},
                  .marks = {{Mark::Along::Y, 5, "aim"}}};
    for (const int items : {100, 1000, 10'000}) {
        figure.series.push_back(withReaders(run, items));
    }
    run.results.figures.push_back(std::move(figure));
    for (const int items : {100, 1000}) withLinks(run, items);
}

}  // namespace cortex::profiler
