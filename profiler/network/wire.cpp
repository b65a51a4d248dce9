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
    std::ifstream file{"/proc/self/net/dev"};
    for (std::string word; file >> word;) {
        std::int64_t octets = 0;
        if (word == "lo:" && file >> octets) return octets;
    }
    throw Error("/proc/self/net/dev does not tell of lo");
}

double octetsPerSecond(int seconds) {
    std::this_thread::sleep_for(std::chrono::seconds{1});  // they have found each other
    const std::int64_t begin = steadyNow(), before = octetsOnLoopback();
    std::this_thread::sleep_for(std::chrono::seconds{seconds});
    const auto octets = static_cast<double>(octetsOnLoopback() - before);
    return octets / (static_cast<double>(steadyNow() - begin) * 1e-9);
}

void print(const std::string& what, int seconds, const std::string& beside) {
    progress(what);
    row(what, text("%.1f kB/s", octetsPerSecond(seconds) * 1e-3), beside);
}

std::string values(int items, int rate) {
    return text("the values alone: %.1f kB/s", items * rate * 8 * 1e-3);
}

// Another agent that links the first samples of one of the given size.
void withLink(const Options& options, int ownerSamples, int links) {
    const Child first{wordsOf({"a", options.domain, ownerSamples})};
    Child second{wordsOf({"b", options.domain, samples, "a", links})};
    second.line();
    second.line();
    const int items = links * itemsPerSample;
    print("two agents, a link of " + std::to_string(items) + " items at 1 kHz", options.seconds,
          values(items, 1000));
}

}  // namespace

void wire(const Options& options) {
    heading(std::string{"On the wire, both directions, with all headers"} +
            (options.alone ? "" : "; others use this loopback interface too"));
    {
        const Child first{bareWords(options.domain)}, second{bareWords(options.domain)};
        print("two bare participants that write nothing", options.seconds, "");
    }
    {
        const Child first{wordsOf({"a", options.domain, samples})};
        const Child second{wordsOf({"b", options.domain, samples})};
        print("two agents of 20 simplexes, idle", options.seconds, "");
    }
    withLink(options, samples, 1);
    withLink(options, 100, 100);
    const Child first{wordsOf({"a", options.domain, 100})};
    Child tool{viewerWords("tool", options.domain, 30)};
    tool.line();
    print("an agent, a tool that looks at 1000 items at 30 Hz", options.seconds, values(1000, 30));
}

}  // namespace cortex::network
