// SPDX-License-Identifier: Apache-2.0
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

constexpr const char* aim = "<= 5 us, any number of readers";

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

void print(const std::string& what, const Costs& costs) {
    row(what, medianAndP99(costs.readAndWrite), "image copied: " + medianAndP99(costs.image), aim);
}

void withoutNetwork(const Options& options, const std::string& what, bool wakes) {
    progress(what);
    Plant::Options none = subject(options, 100);
    none.network.reset();
    none.wakes = wakes;
    Plant plant{none};
    plant.cluster.setTriggerSource<cs::InternalClock>(1ms);
    plant.start();
    for (const std::string& refusal : plant.cluster.realtimeReport()) {
        if (!wakes) row(refusal, "");
    }
    row(what, medianAndP99(record(plant, options.seconds).readAndWrite));
}

void withReaders(const Options& options, int items) {
    Plant plant{subject(options, items)};
    plant.cluster.setTriggerSource<cs::InternalClock>(1ms);
    plant.start();
    std::vector<std::unique_ptr<Child>> readers;
    for (const std::size_t count : {0U, 1U, 4U}) {
        while (readers.size() < count) {
            readers.push_back(std::make_unique<Child>(
                viewerWords("reader" + std::to_string(readers.size()), options.domain, 0)));
        }
        for (std::size_t i = count == 4 ? 1 : 0; i < readers.size(); ++i) readers[i]->line();
        const std::string what =
            std::to_string(items) + " items, " + std::to_string(count) + " readers";
        progress(what);
        print(what, record(plant, options.seconds));
    }
}

void withLinks(const Options& options, int items) {
    const int samples = items / itemsPerSample;
    const std::string what = std::to_string(items) + " items of another agent linked";
    progress(what);
    const Child owner{wordsOf({"owner", options.domain, samples})};
    Plant::Options linking = subject(options, itemsPerSample);
    linking.links = samplePaths("owner", samples);
    Plant plant{linking};
    plant.cluster.setTriggerSource<cs::InternalClock>(1ms);
    plant.start();
    while (!plant.linked()) std::this_thread::sleep_for(1ms);
    print(what, record(plant, options.seconds));
}

}  // namespace

void loopCost(const Options& options) {
    heading("Loop thread: read() and write() of the interface in each cycle of 1 ms");
    withoutNetwork(options, "no network: the stopwatch itself", false);
    withoutNetwork(options, "no network: a thread woken, and nothing else", true);
    for (const int items : {100, 1000, 10'000}) withReaders(options, items);
    for (const int items : {100, 1000}) withLinks(options, items);
}

}  // namespace cortex::network
