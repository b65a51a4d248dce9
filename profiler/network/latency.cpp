// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/error.hpp"

#include "../bare/stream.hpp"
#include "cdr.hpp"
#include "clocks.hpp"
#include "figures.hpp"
#include "messages.hpp"
#include "plant.hpp"
#include "roles.hpp"
#include "statistics.hpp"

#include <atomic>
#include <chrono>
#include <cstring>
#include <mutex>
#include <thread>
#include <utility>

namespace cortex::network {
namespace {

using namespace std::chrono_literals;
using bare::Octets;
using bare::Stream;

// ns from the stamp of a value.
struct Latencies {
    std::vector<std::int64_t> bare;   // to the callback of a bare reader
    std::vector<std::int64_t> taken;  // to where the loop of the linking agent takes it
};

// What comes from the process of the sender, in turn on both ways.
class Arrivals {
public:
    void bare(const Octets::Data& data) {
        std::int64_t stamp = 0;
        if (data.size() < sizeof stamp) return;
        std::memcpy(&stamp, data.data(), sizeof stamp);
        const std::int64_t now = steadyNow();
        const std::lock_guard lock{mutex_};
        all_.bare.push_back(now - stamp);
    }
    void linked(std::int64_t stamp) {
        const std::int64_t now = steadyNow();
        const std::lock_guard lock{mutex_};
        if (stamp == 0 || stamp == last_) return;
        last_ = stamp;
        all_.taken.push_back(now - stamp);
    }
    Latencies take() {
        const std::lock_guard lock{mutex_};
        return std::exchange(all_, {});
    }
    bool both() {
        const std::lock_guard lock{mutex_};
        return !all_.bare.empty() && !all_.taken.empty();
    }

private:
    std::mutex mutex_;
    std::int64_t last_ = 0;
    Latencies all_;
};

// Of the message that brings so many samples.
std::size_t octetsOf(int samples) {
    comms::Block block;
    block.simplexes.resize(static_cast<std::size_t>(samples));
    for (comms::SimplexData& each : block.simplexes) {
        each.ints.resize(1);
        each.floats.resize(itemsPerSample - 1);
    }
    return comms::encodedSize(block);
}

Latencies measure(const Options& options, int samples) {
    // The stream's own octets: encapsulation and length.
    const Child sender{senderWords(options.domain, samples, octetsOf(samples) - 8)};
    const OnCpu other{1};
    Arrivals arrivals;
    const Stream stream{options.domain + 1,
                        Stream::Role::Reader,
                        {[&](const Octets::Data& data) { arrivals.bare(data); }, {}}};
    std::atomic<std::uint32_t> stamped = noSimplex;
    Plant::Options linking{.name = "receiver",
                           .links = samplePaths("sender", samples),
                           .network = loopback(options.domain),
                           .cluster = {.watchdogPeriods = 1e6}};
    linking.onLink = [&](std::uint32_t simplex, const Slice& values) {
        if (simplex == stamped) arrivals.linked(values.ints[0]);
    };
    Plant plant{linking};
    plant.cluster.setTriggerSource<Polling>();
    plant.start();
    stamped = plant.indexOf(linking.links.back());
    const auto end = std::chrono::steady_clock::now() + 30s;
    while (!plant.linked() || !arrivals.both()) {
        if (std::chrono::steady_clock::now() > end) throw Error("nothing came from the sender");
        std::this_thread::sleep_for(10ms);
    }
    std::this_thread::sleep_for(1s);
    arrivals.take();
    std::this_thread::sleep_for(std::chrono::seconds{4 * options.seconds});
    return arrivals.take();
}

}  // namespace

void latency(const Options& options) {
    for (const int samples : {1, 100}) {
        const std::string items = std::to_string(samples * itemsPerSample);
        options.step(0.35, items + " items from loop to loop");
        const Latencies all = measure(options, samples);
        const double bare = median(all.bare);
        addTimes(options,
                 {.id = "comms/latency/" + items,
                  .what = "a value at 1 kHz from the task that writes it to the polling loop of "
                          "another process: " +
                          items + " items, " + std::to_string(octetsOf(samples)) + " octets",
                  .unit = "us",
                  .baseline = bare,
                  .baselineName = "raw Fast DDS, from write() to callback",
                  .aim = profiler::Aim::AtMost,
                  .limit = 1.5 * bare},
                 all.taken);
        addTimes(options,
                 {.id = "comms/latency/" + items + "/raw",
                  .what = "raw Fast DDS with as many octets, every other second",
                  .unit = "us"},
                 all.bare);
    }
}

}  // namespace cortex::network
