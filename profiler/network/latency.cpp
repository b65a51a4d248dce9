// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/clock.hpp"
#include "cortex/core/error.hpp"

#include "../bare/stream.hpp"
#include "dds/participant.hpp"
#include "figures.hpp"
#include "plant.hpp"
#include "roles.hpp"
#include "wire/cdr.hpp"
#include "wire/ids.hpp"
#include "wire/messages.hpp"

#include <chrono>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace cortex::profiler {
namespace {

using namespace std::chrono_literals;

// ns from the stamp of a value to the callback of a bare reader, and to that in which an agent
// hands it to its links.
struct Latencies {
    std::vector<std::int64_t> bare, linked;
};

// What comes from the process of the sender, in turn on both ways.
class Arrivals {
public:
    void bare(const Octets::Data& data) {
        std::int64_t stamp = 0;
        if (data.size() < sizeof stamp) return;
        std::memcpy(&stamp, data.data(), sizeof stamp);
        add(all_.bare, stamp);
    }
    // One of the samples has a stamp; it comes later than the first block.
    void linked(const comms::Block& block) {
        for (const comms::SimplexData& each : block.simplexes) {
            if (each.ints.empty() || each.ints[0] == 0) continue;
            const std::int64_t before = std::exchange(last_, each.ints[0]);
            if (last_ != before) add(all_.linked, last_);
        }
    }
    Latencies take() {
        const std::lock_guard lock{mutex_};
        return std::exchange(all_, {});
    }
    bool both() {
        const std::lock_guard lock{mutex_};
        return !all_.bare.empty() && !all_.linked.empty();
    }

private:
    void add(std::vector<std::int64_t>& to, std::int64_t stamp) {
        const std::int64_t now = monotonicNow();
        const std::lock_guard lock{mutex_};
        to.push_back(now - stamp);
    }

    std::int64_t last_ = 0;
    std::mutex mutex_;
    Latencies all_;
};

// Links simplexes of the agent `owner` as another agent would, without its loop.
class Linker {
public:
    Linker(int domain, const std::string& owner, std::vector<std::string> paths,
           std::function<void(comms::Block&&)> onBlock)
        : participant_{loopback(domain), name},
          presenceOut_{participant_.writer<comms::Presence>(comms::topics::presence)},
          interestOut_{participant_.writer<comms::Interest>(comms::topics::interest)},
          blocksIn_{
              participant_.reader<comms::Block>(comms::topics::linkOf(owner), std::move(onBlock))} {
        presence_.agent = comms::agentId(name);
        presence_.name = name;
        presence_.epoch = 1;
        presence_.role = "agent";
        presence_.state = "running";
        presence_.majors = {1};
        speak();
        comms::Interest interest;
        interest.agent = presence_.agent;
        interest.name = name;
        interest.epoch = presence_.epoch;
        interest.links = std::move(paths);
        interestOut_->write(interest);
    }

    void speak() { presenceOut_->write(presence_); }  // else it is taken for lost after a second

private:
    static constexpr const char* name = "receiver";

    comms::Participant participant_;
    std::unique_ptr<comms::Writer<comms::Presence>> presenceOut_;
    std::unique_ptr<comms::Writer<comms::Interest>> interestOut_;
    std::unique_ptr<comms::Reader<comms::Block>> blocksIn_;
    comms::Presence presence_;
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

Latencies measure(const CommsRun& run, int samples) {
    // The stream's own bytes: encapsulation and length.
    const Child sender{senderWords(run.domain, samples, octetsOf(samples) - 8)};
    const OnCpu other{1};
    Arrivals arrivals;
    const Stream stream{run.domain + 1, Stream::Role::Reader,
                        [&](const Octets::Data& data) { arrivals.bare(data); }};
    Linker linker{run.domain, "sender", samplePaths("sender", samples),
                  [&](comms::Block&& block) { arrivals.linked(block); }};
    const auto speakFor = [&](std::chrono::seconds time, auto until) {
        const auto end = std::chrono::steady_clock::now() + time;
        while (std::chrono::steady_clock::now() < end && !until()) {
            linker.speak();
            std::this_thread::sleep_for(100ms);
        }
    };
    speakFor(30s, [&] { return arrivals.both(); });
    if (!arrivals.both()) throw Error("nothing came from the sender");
    speakFor(1s, [] { return false; });
    arrivals.take();
    speakFor(std::chrono::seconds{4 * run.seconds}, [] { return false; });
    return arrivals.take();
}

}  // namespace

void measureTransit(const CommsRun& run) {
    for (const int samples : {1, 100}) {
        const std::string items = std::to_string(samples * itemsPerSample);
        run.step(0.35, items + " items on their way to another agent");
        const Latencies all = measure(run, samples);
        const double bare = medianMicroseconds(all.bare);
        addTimes(run,
                 {.id = "comms/latency/" + items,
                  .what = "a value at 1 kHz from the task that writes it to where another "
                          "agent takes it from DDS: " +
                          items + " items, " + std::to_string(octetsOf(samples)) + " bytes",
                  .unit = "us",
                  .baseline = bare,
                  .baselineName = "raw Fast DDS, from write() to callback",
                  .aim = Aim::AtMost,
                  .limit = 1.5 * bare},
                 all.linked);
        addTimes(run,
                 {.id = "comms/latency/" + items + "/raw",
                  .what = "raw Fast DDS with as many bytes, every other second",
                  .unit = "us"},
                 all.bare);
    }
}

}  // namespace cortex::profiler
