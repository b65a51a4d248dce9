// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agent.hpp"

#include "figures.hpp"
#include "plant.hpp"
#include "roles.hpp"
#include "statistics.hpp"

#include <chrono>
#include <memory>
#include <thread>

namespace cortex::network {
namespace {

using namespace std::chrono_literals;

Plant::Options subject(const Options& options, int items) {
    return {.name = "subject",
            .samples = items / itemsPerSample,
            .network = loopback(options.domain),
            .cluster = {.priority = 80, .watchdogPeriods = 1e6}};
}

Costs record(Plant& plant, int seconds) {
    ImagePool pool{plant.cluster.agent().tables(), 2};
    plant.network.record(pool);
    std::this_thread::sleep_for(std::chrono::seconds{seconds});
    return plant.network.take();
}

void add(const Options& options, const std::string& id, const std::string& what,
         const Costs& costs) {
    addTimes(options,
             {.id = "comms/loop/" + id,
              .what = "read() and write() of the network in a cycle: " + what,
              .unit = "us",
              .baseline = median(costs.image),
              .baselineName = "copy of the image",
              .aim = profiler::Aim::AtMost,
              .limit = 5},
             costs.readAndWrite);
}

void withoutNetwork(const Options& options, const char* id, const char* what, bool wakes) {
    options.step(0, what);
    Plant::Options none = subject(options, 100);
    none.network.reset();
    none.wakes = wakes;
    Plant plant{none};
    plant.cluster.setTriggerSource<cs::InternalClock>(1ms);
    plant.start();
    for (const std::string& refusal : plant.cluster.realtimeReport()) {
        if (!wakes) options.results.notes.push_back("comms: " + refusal);
    }
    addTimes(options, {.id = std::string{"comms/loop/"} + id, .what = what, .unit = "us"},
             record(plant, options.seconds).readAndWrite);
}

profiler::Series withReaders(const Options& options, int items) {
    const std::string many = std::to_string(items) + " items";
    profiler::Series series{many, {}, false};
    Plant plant{subject(options, items)};
    plant.cluster.setTriggerSource<cs::InternalClock>(1ms);
    plant.start();
    std::vector<std::unique_ptr<Child>> readers;
    for (const std::size_t count : {0U, 1U, 4U}) {
        const std::string number = std::to_string(count);
        options.step(0.05, many + ", " + number + " readers");
        while (readers.size() < count) {
            readers.push_back(std::make_unique<Child>(
                viewerWords("reader" + std::to_string(readers.size()), options.domain, 0)));
        }
        for (std::size_t i = count == 4 ? 1 : 0; i < readers.size(); ++i) readers[i]->line();
        const Costs costs = record(plant, options.seconds);
        add(options, std::to_string(items) + "/" + number,
            many + ", " + number + " readers of every cycle", costs);
        series.points.push_back({static_cast<double>(count), median(costs.readAndWrite)});
    }
    return series;
}

void withLinks(const Options& options, int items) {
    const int samples = items / itemsPerSample;
    const std::string what = std::to_string(items) + " items of another agent linked";
    options.step(0.25, what);
    const Child owner{wordsOf({"owner", options.domain, samples})};
    Plant::Options linking = subject(options, itemsPerSample);
    linking.links = samplePaths("owner", samples);
    Plant plant{linking};
    plant.cluster.setTriggerSource<cs::InternalClock>(1ms);
    plant.start();
    while (!plant.linked()) std::this_thread::sleep_for(1ms);
    add(options, "links/" + std::to_string(items), what, record(plant, options.seconds));
}

}  // namespace

void loopCost(const Options& options) {
    withoutNetwork(options, "stopwatch", "no network: the stopwatch itself", false);
    withoutNetwork(options, "wake", "no network: a thread woken in each cycle, nothing else", true);
    profiler::Figure figure{.id = "comms-loop-cost",
                            .title = "What the network costs the loop",
                            .paper = "",
                            .setup =
                                "Median of read() and write() in each cycle of 1 ms; readers "
                                "are processes that look at everything in every cycle.",
                            .x = {"readers", "", false},
                            .y = {"time in a cycle", "us", false},
                            .series = {},
                            .marks = {{profiler::Mark::Along::Y, 5, "aim"}}};
    for (const int items : {100, 1000, 10'000}) {
        figure.series.push_back(withReaders(options, items));
    }
    options.results.figures.push_back(std::move(figure));
    for (const int items : {100, 1000}) withLinks(options, items);
}

}  // namespace cortex::network
