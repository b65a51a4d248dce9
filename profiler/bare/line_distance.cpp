// SPDX-License-Identifier: Apache-2.0
#include "bare/line_distance.hpp"

#include "pause_briefly.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

#include <pthread.h>
#include <sched.h>

namespace cortex::profiler {
namespace {

constexpr int rounds = 10, passes = 50;

void pin(pthread_t thread, int cpu) {
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(static_cast<std::size_t>(cpu), &set);
    pthread_setaffinity_np(thread, sizeof set, &set);
}

void waitFor(const std::atomic<int>& line, int value) {
    while (line.load(std::memory_order_acquire) != value) cs::pauseBriefly();
}

}  // namespace

std::unique_ptr<LineDistance> LineDistance::ofFirstCpus() {
    cpu_set_t usable;
    CPU_ZERO(&usable);
    sched_getaffinity(0, sizeof usable, &usable);
    int first = -1;
    for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
        if (!CPU_ISSET(static_cast<std::size_t>(cpu), &usable)) continue;
        if (first >= 0) return std::make_unique<LineDistance>(first, cpu);
        first = cpu;
    }
    return nullptr;
}

LineDistance::LineDistance(int cpu, int other) : cpu_{cpu}, other_{[this] { answer(); }} {
    pin(other_.native_handle(), other);
}

LineDistance::~LineDistance() {
    asked_ = -1;
    asked_.notify_one();
    other_.join();
}

void LineDistance::answer() {
    for (int seen = 0;;) {
        asked_.wait(seen);
        seen = asked_;
        if (seen < 0) return;
        for (int pass = 0; pass < (rounds + 1) * passes; ++pass) {
            waitFor(line_, 2 * pass + 1);
            line_.store(2 * pass + 2, std::memory_order_release);
        }
    }
}

double LineDistance::measure() {
    cpu_set_t before;
    pthread_getaffinity_np(pthread_self(), sizeof before, &before);
    pin(pthread_self(), cpu_);
    line_ = 0;
    ++asked_;
    asked_.notify_one();
    double least = std::numeric_limits<double>::infinity();
    int pass = 0;
    for (int round = 0; round <= rounds; ++round) {  // the first one waits for the other thread
        const auto begin = std::chrono::steady_clock::now();
        for (const int end = pass + passes; pass < end; ++pass) {
            line_.store(2 * pass + 1, std::memory_order_release);
            waitFor(line_, 2 * pass + 2);
        }
        const std::chrono::duration<double, std::nano> took =
            std::chrono::steady_clock::now() - begin;
        if (round > 0) least = std::min(least, took.count() / passes);
    }
    pthread_setaffinity_np(pthread_self(), sizeof before, &before);
    return least;
}

}  // namespace cortex::profiler
