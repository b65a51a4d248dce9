// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/event_count.hpp"

#include "threads/realtime_thread.hpp"
#include "threads/scheduler.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace cortex::cs {

struct PoolOptions {
    std::string name = "cortex";
    std::uint32_t threads = 0;    // with the loop's own; 0: as the schedule says
    int priority = 0;             // see ThreadOptions
    std::vector<int> affinity{};  // CPUs for all threads, the loop's first; empty: all usable
    bool pin = true;              // each thread to one of them, where they share work
    std::uint32_t spinMicroseconds = 20;  // before a waiting thread sleeps
    bool oversubscribe = false;           // tests: more real-time threads than CPUs

    // Runs in each worker thread before its first cycle; must not throw.
    void (*onStart)(void* context, std::uint32_t worker) = nullptr;
    void* onStartContext = nullptr;
};

// Runs the chunks of a schedule once in each cycle(), on the calling (loop) thread as worker 0 and
// on workers of its own. Made and destroyed outside the loop; cycle() neither allocates nor locks.
//
// **Invariants**
// 1. Each cycle has an epoch, an even number that grows. A chunk has run in a cycle when its done
//    word holds the epoch of that cycle.
// 2. Each worker has a list of chunks in topological order, the same in every cycle, so that their
//    data stays in its caches. Chunks leave a list at its front only, by one compare-and-exchange
//    of its ticket, which holds the epoch: so each chunk runs once in a cycle, and a worker that
//    comes late cannot take a chunk of another cycle.
// 3. A chunk is taken only after all its predecessors have run in this cycle. What they wrote is
//    seen by it, because it has read their done words.
// 4. The first chunk, in topological order, of those that were not taken is the first of its list,
//    and all before it are taken: so as long as chunks are left, one is ready or soon will be.
// 5. A worker that finds its own list blocked looks at the lists of the others.
// 6. A worker reports what it took only after it has found nothing left to take. The cycle ends
//    when all chunks are reported, so no chunk runs across the end of a cycle.
// 7. A waiting thread spins for a bounded time and then sleeps: a spinning real-time thread may
//    keep the thread that it waits for off the CPU.
// 8. Whoever completes a chunk looks for sleepers afterwards, and a sleeper looks for a chunk after
//    it has said that it sleeps, both sequentially consistent: one of them sees the other.
class ThreadPool {
public:
    // Must not throw.
    using ChunkFunction = void (*)(void* context, std::uint32_t chunk, std::uint32_t worker);

    ThreadPool(const Schedule& schedule, ChunkFunction run, void* context, PoolOptions options);
    ~ThreadPool();
    ThreadPool(const ThreadPool&) = delete;
    ThreadPool& operator=(const ThreadPool&) = delete;

    // Called once by the thread that will call cycle(): pins it and sets its priority as the
    // workers'. Returns what the system refused.
    std::vector<std::string> configureLoopThread() const;

    // The CPU of the loop thread alone, for a pool that takes the place of another. Any thread.
    void placeLoopThread(std::thread::native_handle_type loop) const;

    // `next`: when the cycle after this one is due, ns of the monotonic clock, so that workers
    // wake by themselves, with the loop thread, which then need not wake them; 0: not known.
    void cycle(std::int64_t next = 0) noexcept;

    std::uint32_t threads() const noexcept { return static_cast<std::uint32_t>(workers_.size()); }

    // The CPUs of its threads, the loop's first; empty: the system places them.
    std::vector<int> pinnedTo() const;

    // How often this worker slept within a cycle because what it waited for took too long.
    std::uint64_t sleeps(std::uint32_t worker) const noexcept;

    // What the system refused to the workers, in sentences.
    const std::vector<std::string>& report() const noexcept { return report_; }

private:
    class Spin;
    struct alignas(64) DoneWord {
        std::atomic<std::uint32_t> epoch{0};  // in which the chunk last ran
    };
    struct alignas(64) Worker {
        std::atomic<std::uint64_t> sleeps{0};
        std::atomic<bool> isConfigured{false};
        std::vector<std::string> report;
        std::thread thread;
    };
    // Chunks in topological order, taken from the front by any worker.
    struct alignas(64) List {
        std::atomic<std::uint64_t> ticket{0};  // epoch << 32 | next chunk to take
        std::vector<std::uint32_t> chunks;
    };
    // What a worker can do next.
    struct Found {
        enum class What : std::uint8_t { Nothing, Blocked, Taken };
        What what = What::Nothing;
        std::uint32_t chunk = 0, epoch = 0;  // where one was taken
    };

    ThreadOptions threadOptions(std::uint32_t worker) const;
    void startWorkers();
    void stopWorkers() noexcept;
    void workerMain(std::uint32_t worker);
    void listChunks();
    bool waitForCycle(std::uint32_t& seen) noexcept;
    void takeChunks(std::uint32_t worker) noexcept;
    Found find(std::uint32_t worker) noexcept;
    bool isReady(const Chunk& chunk, std::uint32_t epoch) const noexcept;
    void complete(std::uint32_t chunk, std::uint32_t epoch) noexcept;
    Found sleepOrFind(std::uint32_t worker) noexcept;
    void countSleep(std::uint32_t worker) noexcept;

    // Read-only in the loop.
    const std::vector<Chunk> chunks_;
    const std::vector<std::uint32_t> predecessors_;
    std::vector<bool> isAwaited_;  // by chunk: some chunk names it
    const ChunkFunction run_;
    void* const context_;
    const PoolOptions options_;
    const std::chrono::nanoseconds spinTime_;
    std::vector<std::string> report_;
    std::vector<Worker> workers_;
    std::vector<List> lists_;           // by worker
    std::unique_ptr<DoneWord[]> done_;  // by chunk
    std::uint32_t epoch_ = 0;           // even; loop thread only

    alignas(64) std::atomic<std::uint32_t> remaining_{0};  // chunks not yet reported as done
    alignas(64) std::atomic<std::uint32_t> sleepers_{0};   // in a cycle, for lack of a ready chunk
    alignas(64) EventCount progress_;                      // they sleep on it
    alignas(64) EventCount started_;     // epoch; workers sleep on it between cycles
    std::atomic<std::int64_t> next_{0};  // when they need no longer sleep
    alignas(64) EventCount finished_;    // epoch; the loop thread sleeps on it at the cycle's end
    std::atomic<bool> stopping_{false};
};

}  // namespace cortex::cs
