// SPDX-License-Identifier: Apache-2.0
#include "cortex/comms/mirror.hpp"
#include "cortex/core/error.hpp"

#include "../bare/stream.hpp"
#include "figures.hpp"
#include "plant.hpp"
#include "roles.hpp"
#include "statistics.hpp"

#include <atomic>
#include <chrono>
#include <deque>
#include <map>
#include <thread>

namespace cortex::network {
namespace {

using namespace std::chrono_literals;
using bare::Stream;

constexpr int samples = 18;  // with the worker and the agent itself: 20 simplexes

std::string nameOf(int round) { return "far" + std::to_string(round); }

// ns from when one began to join.
struct Times {
    std::vector<std::int64_t> bare, linked, mirrored;
};

std::int64_t waitFor(const std::atomic<std::int64_t>& time) {
    const auto end = std::chrono::steady_clock::now() + 30s;
    while (time.load() == 0) {
        if (std::chrono::steady_clock::now() > end) throw Error("one did not find the other");
        std::this_thread::sleep_for(1ms);
    }
    return time.load();
}

// Everything of an agent is known at once.
std::int64_t whenKnown(const comms::Mirror& mirror, const std::string& path) {
    const auto end = std::chrono::steady_clock::now() + 30s;
    while (!mirror.ownerOf(path)) {
        if (std::chrono::steady_clock::now() > end) throw Error("an agent was not found");
        std::this_thread::sleep_for(1ms);
    }
    return steadyNow();
}

Times measure(const Options& options) {
    std::atomic<std::int64_t> matched = 0;
    const Stream stream{
        options.domain + 1, Stream::Role::Reader, {{}, [&] { matched = steadyNow(); }}};
    std::deque<std::atomic<std::int64_t>> bound(static_cast<std::size_t>(options.rounds));
    std::map<std::uint32_t, int> roundOf;  // by simplex
    Plant::Options linking{.name = "near", .network = loopback(options.domain)};
    for (int i = 0; i < options.rounds; ++i) linking.links.push_back(samplePath(nameOf(i), 0));
    linking.onLink = [&](std::uint32_t simplex, const Slice&) {
        auto& time = bound.at(static_cast<std::size_t>(roundOf.at(simplex)));
        if (time == 0) time = steadyNow();
    };
    Plant plant{linking};
    plant.cluster.setTriggerSource<cs::InternalClock>(1ms);
    plant.start();
    for (int i = 0; i < options.rounds; ++i) {
        roundOf[plant.indexOf(linking.links[static_cast<std::size_t>(i)])] = i;
    }
    comms::Mirror mirror{"figures", loopback(options.domain)};
    whenKnown(mirror, "/near");

    Times times;
    for (int i = 0; i < options.rounds; ++i) {
        options.step(0.6, "discovery");
        {
            Child far{wordsOf({nameOf(i), options.domain, samples})};
            const std::int64_t mirrored = whenKnown(mirror, samplePath(nameOf(i), 0));
            const std::int64_t began = std::stoll(far.line());
            times.mirrored.push_back(mirrored - began);
            times.linked.push_back(waitFor(bound[static_cast<std::size_t>(i)]) - began);
        }
        matched = 0;
        Child other{bareWords(options.domain + 1)};
        const std::int64_t began = std::stoll(other.line());
        times.bare.push_back(waitFor(matched) - began);
    }
    return times;
}

void add(const Options& options, const char* id, const char* what,
         const std::vector<std::int64_t>& times, const std::vector<std::int64_t>& bare) {
    profiler::Quantity quantity{.id = std::string{"comms/discovery/"} + id,
                                .what = what,
                                .unit = "ms",
                                .value = median(times) * 1e-3,
                                .baseline = median(bare) * 1e-3,
                                .baselineName = "two bare participants matched"};
    for (const std::int64_t each : times) {
        quantity.repeats.push_back(static_cast<double>(each) * 1e-6);
    }
    options.add(std::move(quantity));
}

}  // namespace

void discovery(const Options& options) {
    const Times times = measure(options);
    add(options, "linked",
        "an agent of 20 simplexes begins to join until its values are in the loop of one that "
        "links it",
        times.linked, times.bare);
    add(options, "mirrored", "the same until a tool has all its types and simplexes",
        times.mirrored, times.bare);
}

}  // namespace cortex::network
