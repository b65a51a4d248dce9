// SPDX-License-Identifier: Apache-2.0
#include "register_work.hpp"

#include "register_rounds.hpp"

#include <pthread.h>
#include <sched.h>
#include <sys/prctl.h>
#include <time.h>

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
    cpu_set_t usable, own;
    CPU_ZERO(&usable);
    CPU_ZERO(&own);
    sched_getaffinity(0, sizeof usable, &usable);
    int cpu = 0;
    for (std::uint32_t seen = 0; cpu < CPU_SETSIZE; ++cpu) {
        if (CPU_ISSET(cpu, &usable) && seen++ == number) break;
    }
    if (cpu < CPU_SETSIZE) CPU_SET(cpu, &own);
    pthread_setaffinity_np(pthread_self(), sizeof own, &own);
    prctl(PR_SET_TIMERSLACK, 1UL);  // as the loop's threads have
    const sched_param parameters{priority};
    if (priority > 0) pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
    for (std::uint32_t seen = 0;; ++seen) {
        prepared_.wait(seen);
        constexpr std::int64_t second = 1'000'000'000;
        const std::int64_t deadline = deadline_;
        const timespec time{deadline / second, deadline % second};
        clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr);
        while (begun_ == seen && !ending_) {
        }
        if (ending_) return;
        computeRounds(rounds_);
        ++done_;
    }
}

}  // namespace cortex::profiler
