// SPDX-License-Identifier: Apache-2.0
// Runs each scenario for a fixed number of cycles on one thread, to have its instructions counted
// by callgrind: `./run test instructions`. Counting is on from one heartbeat of the loop to
// another, on the loop's thread alone; a dump for each scenario, labelled with its name and its
// cycles.
#include "cortex/core/error.hpp"
#include "cortex/cs/testing.hpp"

#include "instructions/scenarios.hpp"
#include "subject/subject.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <valgrind/callgrind.h>

namespace {

constexpr std::int64_t second = 1'000'000'000;
constexpr std::int64_t look = 1000;                  // ns that pass with each
thread_local constinit std::int64_t playedTime = 0;  // ns; 0: this thread has the system's time

}  // namespace

// In the program, and so before that of the C library. The loop waits for no time here.
extern "C" int clock_gettime(clockid_t clock, timespec* time) noexcept {
    if (playedTime == 0) return static_cast<int>(syscall(SYS_clock_gettime, clock, time));
    playedTime += look;
    *time = {playedTime / second, playedTime % second};
    return 0;
}

namespace cortex::profiler {

namespace {

// Both divide by 64, the turn in which the loop refreshes its percentiles.
constexpr std::int64_t warmCycles = 128;
constexpr std::int64_t countedCycles = 128;
constexpr int longestStart = 5000;  // cycles

// Starts and stops counting at the ends of two cycles, on the thread that runs them.
struct Counting {
    std::int64_t from = -1, to = -1;

    void heartbeat(std::int64_t cycle) const {
        if (cycle == from || cycle == to) CALLGRIND_TOGGLE_COLLECT;
    }
};

class HotPath {
public:
    explicit HotPath(const Scenario& scenario)
        : scenario_{scenario}, tree_{scenario.make()}, cluster_{"hot", options()} {
        cluster_.addSimplexTree(tree_);
        trigger_ = &cluster_.setTriggerSource<BurstTrigger>();
        cluster_.addHeartbeat([this](const cs::Heartbeat& beat) {
            if (beat.alive) counting_.heartbeat(beat.cycle);
        });
        cs::ClusterTesting::set(cluster_, {.onThreadStart = [](std::uint32_t) {
                                    playedTime =
                                        std::chrono::steady_clock::now().time_since_epoch().count();
                                }});
        cluster_.start();
    }

    // Throws Error where the scenario does not do what it is meant to.
    void count() {
        startAll();
        trigger_->burst(warmCycles - 1);
        counting_.from = cluster_.image().cycle() + 1;  // read by a cycle that has not begun
        counting_.to = counting_.from + countedCycles;
        CALLGRIND_START_INSTRUMENTATION;
        trigger_->burst(1);
        const std::int64_t before = commands();
        trigger_->burst(countedCycles);
        CALLGRIND_STOP_INSTRUMENTATION;
        const std::string label = scenario_.name + (" " + std::to_string(countedCycles));
        CALLGRIND_DUMP_STATS_AT(label.c_str());
        const std::int64_t executed = commands() - before;
        if (executed != scenario_.commands * countedCycles) {
            throw Error(std::string{scenario_.name} + ": " + std::to_string(executed) +
                        " commands in " + std::to_string(countedCycles) + " cycles, expected " +
                        std::to_string(scenario_.commands) + " in each");
        }
    }

private:
    static cs::ClusterOptions options() {
        cs::ClusterOptions options;
        options.watchdogPeriods = 1e6;  // callgrind is slow
        return options;
    }
    void startAll() {
        cluster_.send("/hot", "startup", {{"prefix", "/"}});
        for (int cycle = 0; !allActive(); ++cycle) {
            if (cycle == longestStart) throw Error(std::string{scenario_.name} + ": no startup");
            trigger_->burst(1);
        }
    }
    bool allActive() {
        const Image image = cluster_.image();
        return std::ranges::all_of(tree_.simplexes(), [&](const auto& entry) {
            return dynamic_cast<cs::SimplexCS*>(entry.second.get()) == nullptr ||
                   image.get<std::int64_t>(entry.first, "state") ==
                       static_cast<std::int64_t>(State::Active);
        });
    }
    std::int64_t commands() { return cluster_.image().get<std::int64_t>("/hot", "commandCount"); }

    const Scenario& scenario_;
    SimplexTree tree_;
    cs::ClusterCS cluster_;
    BurstTrigger* trigger_;
    Counting counting_;
};

int run(const std::vector<std::string_view>& names) {
    if (RUNNING_ON_VALGRIND == 0) std::cerr << "not under callgrind: nothing is counted\n";
    for (const Scenario& scenario : scenarios()) {
        if (!names.empty() && std::ranges::find(names, scenario.name) == names.end()) continue;
        HotPath path{scenario};
        path.count();
        std::cout << scenario.name << ' ' << countedCycles << std::endl;
    }
    return 0;
}

}  // namespace

}  // namespace cortex::profiler

int main(int argc, char** argv) {
    try {
        return cortex::profiler::run({argv + 1, argv + argc});
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}
