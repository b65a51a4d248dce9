// SPDX-License-Identifier: Apache-2.0
#include "thread_pool.hpp"

#include "realtime_thread.hpp"

#include <algorithm>

namespace cortex::cs {
namespace {

constexpr std::uint32_t EpochStep = 2;  // WakeWord keeps the lowest bit

void pauseBriefly() noexcept {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    asm volatile("yield");
#endif
}

}  // namespace

/// A budget of time for busy waiting. Short waits never read the clock.
class ThreadPool::Spin {
public:
    explicit Spin(std::chrono::nanoseconds limit) : limit_(limit) {}

    /// Waits a moment; false once the budget is spent.
    bool spend() noexcept {
        if (isSpent_) return false;
        pauseBriefly();
        if (++pauses_ % PausesPerClockReading != 0) return true;
        const auto now = std::chrono::steady_clock::now();
        if (pauses_ == PausesPerClockReading) end_ = now + limit_;
        isSpent_ = now >= end_;
        return !isSpent_;
    }

private:
    static constexpr std::uint32_t PausesPerClockReading = 32;

    std::chrono::nanoseconds limit_;
    std::chrono::steady_clock::time_point end_;
    std::uint32_t pauses_ = 0;
    bool isSpent_ = false;
};

ThreadPool::ThreadPool(const Schedule& schedule, ChunkFunction run, void* context,
                       PoolOptions options)
    : chunks_(schedule.chunks),
      predecessors_(schedule.predecessors),
      isAwaited_(schedule.chunks.size()),
      run_(run),
      context_(context),
      options_(std::move(options)),
      spinTime_(std::chrono::microseconds(options_.spinMicroseconds)),
      done_(std::make_unique<DoneWord[]>(schedule.chunks.size())),
      ticket_(schedule.chunks.size()) {
    for (const std::uint32_t chunk : predecessors_) isAwaited_[chunk] = true;
    std::uint32_t threads = options_.threads != 0 ? options_.threads : schedule.threads;
    if (!options_.oversubscribe) {
        threads = clampThreads(threads, options_.priority, options_.affinity, report_);
    }
    workers_ = std::vector<Worker>(chunks_.empty() ? 1 : std::max(1U, threads));
    try {
        startWorkers();
    } catch (...) {
        stopWorkers();
        throw;
    }
}

ThreadPool::~ThreadPool() { stopWorkers(); }

/// Threads that share work are pinned, each to a CPU of its own: measured, the system otherwise
/// wakes workers on the loop's own CPU, where they only slow it down.
ThreadOptions ThreadPool::threadOptions(std::uint32_t worker) const {
    ThreadOptions thread{options_.name + (worker == 0 ? "-loop" : "-" + std::to_string(worker)),
                         options_.priority, options_.affinity};
    const bool sharesWork = threads() > 1 && threads() <= cpuCount(options_.affinity);
    if (thread.priority != 0 || sharesWork) {
        thread.affinity = {cpuForThread(options_.affinity, worker)};
    }
    return thread;
}

std::vector<std::string> ThreadPool::configureLoopThread() const {
    prefaultStack();
    return configureThisThread(threadOptions(0));
}

void ThreadPool::startWorkers() {
    for (std::uint32_t worker = 1; worker < threads(); ++worker) {
        workers_[worker].thread = std::thread(&ThreadPool::workerMain, this, worker);
    }
    for (std::uint32_t worker = 1; worker < threads(); ++worker) {
        workers_[worker].isConfigured.wait(false);
        const std::vector<std::string>& lines = workers_[worker].report;
        report_.insert(report_.end(), lines.begin(), lines.end());
    }
}

void ThreadPool::stopWorkers() noexcept {
    stopping_.store(true, std::memory_order_release);
    started_.publish(epoch_ + EpochStep);
    for (Worker& worker : workers_) {
        if (worker.thread.joinable()) worker.thread.join();
    }
}

void ThreadPool::workerMain(std::uint32_t worker) {
    workers_[worker].report = configureThisThread(threadOptions(worker));
    prefaultStack();
    if (options_.onStart != nullptr) options_.onStart(options_.onStartContext, worker);
    workers_[worker].isConfigured.store(true);
    workers_[worker].isConfigured.notify_one();
    while (waitForCycle()) takeChunks(worker);
}

/// False: the pool stops.
bool ThreadPool::waitForCycle() noexcept {
    Spin spin(spinTime_);
    for (;;) {
        const std::uint32_t seen = started_.value();
        if (stopping_.load(std::memory_order_acquire)) return false;
        const auto next = static_cast<std::uint32_t>(ticket_.load(std::memory_order_acquire));
        if (next < chunks_.size()) return true;
        if (!spin.spend()) started_.sleepWhile(seen);
    }
}

void ThreadPool::cycle() noexcept {
    if (threads() == 1) {
        setFloatingPointMode();
        for (std::uint32_t chunk = 0; chunk < chunks_.size(); ++chunk) {
            if (chunks_[chunk].count != 0) run_(context_, chunk, 0);
        }
        return;
    }
    epoch_ += EpochStep;
    remaining_.store(static_cast<std::uint32_t>(chunks_.size()), std::memory_order_relaxed);
    ticket_.store(std::uint64_t{epoch_} << 32, std::memory_order_release);
    started_.publish(epoch_);
    takeChunks(0);
    Spin spin(spinTime_);
    waitFor(finished_, epoch_, spin, 0);
}

/// Runs chunks until none is left to take. A cycle cannot end before those taken here are reported
/// in remaining_, so all of them belong to one epoch.
void ThreadPool::takeChunks(std::uint32_t worker) noexcept {
    setFloatingPointMode();
    std::uint32_t taken = 0;
    std::uint32_t epoch = 0;
    for (;;) {
        const std::uint64_t ticket = ticket_.fetch_add(1, std::memory_order_acq_rel);
        const auto index = static_cast<std::uint32_t>(ticket);
        if (index >= chunks_.size()) break;
        epoch = static_cast<std::uint32_t>(ticket >> 32);
        const Chunk& chunk = chunks_[index];
        if (chunk.predecessorCount != 0) waitForPredecessors(chunk, epoch, worker);
        if (chunk.count != 0) run_(context_, index, worker);
        if (isAwaited_[index]) done_[index].word.publish(epoch);
        ++taken;
    }
    if (taken != 0 && remaining_.fetch_sub(taken, std::memory_order_acq_rel) == taken) {
        finished_.publish(epoch);
    }
}

void ThreadPool::waitForPredecessors(const Chunk& chunk, std::uint32_t epoch,
                                     std::uint32_t worker) noexcept {
    Spin spin(spinTime_);
    const std::uint32_t* const first = predecessors_.data() + chunk.firstPredecessor;
    for (std::uint32_t i = 0; i < chunk.predecessorCount; ++i) {
        waitFor(done_[first[i]].word, epoch, spin, worker);
    }
}

void ThreadPool::waitFor(WakeWord& word, std::uint32_t epoch, Spin& spin,
                         std::uint32_t worker) noexcept {
    for (;;) {
        const std::uint32_t value = word.value();
        if (value == epoch) return;
        if (spin.spend()) continue;
        std::atomic<std::uint64_t>& sleeps = workers_[worker].sleeps;
        sleeps.store(sleeps.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
        word.sleepWhile(value);
    }
}

std::uint64_t ThreadPool::sleeps(std::uint32_t worker) const noexcept {
    return workers_[worker].sleeps.load(std::memory_order_relaxed);
}

}  // namespace cortex::cs
