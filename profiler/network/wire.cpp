// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/error.hpp"

#include "figures.hpp"
#include "plant.hpp"
#include "roles.hpp"
#include "statistics.hpp"

#include <chrono>
#include <fstream>
#include <string>
#include <thread>

namespace cortex::network {
namespace {

constexpr int samples = 18;  // with the worker and the agent itself: 20 simplexes

std::int64_t octetsOnLoopback() {
    std::ifstream file{"/proc/thread-self/net/dev"};
    for (std::string word; file >> word;) {
        std::int64_t octets = 0;
        if (word == "lo:" && file >> octets) return octets;
    }
    throw Error("/proc/thread-self/net/dev does not tell of lo");
}

double octetsPerSecond(int seconds) {
    std::this_thread::sleep_for(std::chrono::seconds{1});  // they have found each other
    const std::int64_t begin = steadyNow(), before = octetsOnLoopback();
    std::this_thread::sleep_for(std::chrono::seconds{seconds});
    const auto octets = static_cast<double>(octetsOnLoopback() - before);
    return octets / (static_cast<double>(steadyNow() - begin) * 1e-9);
}

void add(const Options& options, const char* id, const std::string& what, double values = 0) {
    options.step(0.75, what);
    profiler::Quantity quantity{.id = std::string{"comms/wire/"} + id,
                                .what = "on the wire, both directions, all headers: " + what,
                                .unit = "kB/s",
                                .value = octetsPerSecond(options.seconds) * 1e-3};
    if (values > 0) {
        quantity.baseline = values;
        quantity.baselineName = "the values alone";
    }
    options.add(std::move(quantity));
}

double valuesOf(int items, int rate) { return items * rate * 8 * 1e-3; }

// Another agent that links the first samples of one of the given size.
void withLink(const Options& options, const char* id, int ownerSamples, int links) {
    const Child first{wordsOf({"a", options.domain, ownerSamples})};
    Child second{wordsOf({"b", options.domain, samples, "a", links})};
    second.line();
    second.line();
    const int items = links * itemsPerSample;
    add(options, id, "two agents, a link of " + std::to_string(items) + " items at 1 kHz",
        valuesOf(items, 1000));
}

}  // namespace

void wire(const Options& options) {
    {
        const Child first{bareWords(options.domain)}, second{bareWords(options.domain)};
        add(options, "bare", "two bare participants that write nothing");
    }
    {
        const Child first{wordsOf({"a", options.domain, samples})};
        const Child second{wordsOf({"b", options.domain, samples})};
        add(options, "idle", "two agents of 20 simplexes, idle");
    }
    withLink(options, "link/10", samples, 1);
    withLink(options, "link/1000", 100, 100);
    const Child first{wordsOf({"a", options.domain, 100})};
    Child tool{viewerWords("tool", options.domain, 30)};
    tool.line();
    add(options, "view/1000", "an agent, a tool that looks at 1,000 items at 30 Hz",
        valuesOf(1000, 30));
}

}  // namespace cortex::network
