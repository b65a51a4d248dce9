// SPDX-License-Identifier: Apache-2.0
#include "threads/line_distance.hpp"

#include "threads/pause_briefly.hpp"
#include "threads/realtime_thread.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <thread>

namespace cortex::cs {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int rounds = 6, passes = 20;  // the first round waits for the other thread
constexpr std::chrono::milliseconds patience{20};
constexpr std::chrono::microseconds glance{100};
constexpr int pausesPerClockReading = 256;

// Two threads that hand a line to and fro.
struct PingPong {
    struct alignas(64) {
        std::atomic<int> value{-1};  // 0 once both are placed
    } line;
    std::atomic<int> running{2};
    Clock::time_point end = Clock::now() + patience;
    double least = std::numeric_limits<double>::infinity();  // microseconds to and fro

    bool waitFor(int value) const {
        for (int pauses = 1; line.value.load(std::memory_order_acquire) != value; ++pauses) {
            pauseBriefly();
            if (pauses % pausesPerClockReading == 0 && Clock::now() > end) return false;
        }
        return true;
    }

    void ask() {
        bool answered = waitFor(0);
        for (int pass = 0; answered && pass < rounds * passes;) {
            const auto begin = Clock::now();
            for (const int last = pass + passes; answered && pass < last; ++pass) {
                line.value.store(2 * pass + 1, std::memory_order_release);
                answered = waitFor(2 * pass + 2);
            }
            const std::chrono::duration<double, std::micro> took = Clock::now() - begin;
            if (answered && pass > passes) least = std::min(least, took.count() / passes);
        }
        --running;
    }

    void answer() {
        for (int pass = 0; pass < rounds * passes && waitFor(2 * pass + 1); ++pass) {
            line.value.store(2 * pass + 2, std::memory_order_release);
        }
        --running;
    }
};

double between(int cpu, int other) {
    PingPong game;
    std::jthread asking{[&] { game.ask(); }}, answering{[&] { game.answer(); }};
    placeThread(asking.native_handle(), {cpu});
    placeThread(answering.native_handle(), {other});
    game.line.value.store(0, std::memory_order_release);
    while (game.running > 0 && Clock::now() < game.end) std::this_thread::sleep_for(glance);
    if (game.running > 0) {  // a loop that never rests may keep them off these CPUs for ever
        placeThread(asking.native_handle(), {});
        placeThread(answering.native_handle(), {});
    }
    asking.join();
    answering.join();
    return game.least < std::numeric_limits<double>::infinity() ? game.least : 0;
}

}  // namespace

double lineMicroseconds(const std::vector<int>& affinity, std::uint32_t threads) {
    const std::uint32_t cpus = std::min(threads, cpuCount(affinity));
    double sum = 0;
    int known = 0;
    for (std::uint32_t thread = 1; thread < cpus; ++thread) {
        const double line = between(cpuForThread(affinity, 0), cpuForThread(affinity, thread));
        sum += line;
        known += line > 0 ? 1 : 0;
    }
    return known == 0 ? 0 : sum / known;
}

}  // namespace cortex::cs
