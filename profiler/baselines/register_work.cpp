// SPDX-License-Identifier: Apache-2.0
#include "register_work.hpp"

#include "threads/realtime_thread.hpp"

#include <chrono>

namespace cortex::profiler {

RegisterWork::RegisterWork(std::uint32_t threads, int priority) {
    for (std::uint32_t i = 1; i < threads; ++i) {
        helpers_.emplace_back([this, i, priority] { help(i, priority); });
    }
}

RegisterWork::~RegisterWork() {
    ending_ = true;
    prepare(0);
    for (std::thread& helper : helpers_) helper.join();
}

void RegisterWork::prepare(std::int64_t deadline) {
    deadline_ = deadline;
    ++prepared_;
    prepared_.notify_all();
}

void RegisterWork::cycle(std::int64_t rounds) {
    rounds_ = rounds;
    done_ = 0;
    ++begun_;
    computeRounds(rounds);
    while (done_ < helpers_.size()) {
    }
}

void RegisterWork::help(std::uint32_t number, int priority) {
    cs::configureThisThread({"register-work", priority, {cs::cpuForThread({}, number)}});
    for (std::uint32_t seen = 0;; ++seen) {
        prepared_.wait(seen);
        std::this_thread::sleep_until(
            std::chrono::steady_clock::time_point{std::chrono::nanoseconds{deadline_}});
        while (begun_ == seen && !ending_) {
        }
        if (ending_) return;
        computeRounds(rounds_);
        ++done_;
    }
}

}  // namespace cortex::profiler
