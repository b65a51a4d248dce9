// SPDX-License-Identifier: Apache-2.0
#include "threads/thread_pool.hpp"

#include "threads/pause_briefly.hpp"
#include "threads/realtime_thread.hpp"

#include <algorithm>
#include <span>

namespace cortex::cs {

// A budget of time for busy waiting. Short waits never read the clock.
class ThreadPool::Spin {
public:
    explicit Spin(std::chrono::nanoseconds limit) : limit_(limit) {}

    // Waits a moment; false once the budget is spent.
    bool spend() noexcept {
        if (isSpent_) return false;
        pauseBriefly();
        if (++pauses_ % pausesPerClockReading != 0) return true;
        const auto now = std::chrono::steady_clock::now();
        if (pauses_ == pausesPerClockReading) end_ = now + limit_;
        isSpent_ = now >= end_;
        return !isSpent_;
    }

private:
    static constexpr std::uint32_t pausesPerClockReading = 32;

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
      done_(std::make_unique<DoneWord[]>(schedule.chunks.size())) {
    for (const std::uint32_t chunk : predecessors_) isAwaited_[chunk] = true;
    std::uint32_t threads = options_.threads != 0 ? options_.threads : schedule.threads;
    if (!options_.oversubscribe) {
        threads = clampThreads(threads, options_.priority, options_.affinity, report_);
    }
    workers_ = std::vector<Worker>(chunks_.empty() ? 1 : std::max(1U, threads));
    lists_ = std::vector<List>(workers_.size());
    listChunks();
    try {
        startWorkers();
    } catch (...) {
        stopWorkers();
        throw;
    }
}

ThreadPool::~ThreadPool() { stopWorkers(); }

void ThreadPool::listChunks() {
    for (std::uint32_t chunk = 0; chunk < chunks_.size(); ++chunk) {
        lists_[homeOf(chunks_[chunk], threads())].chunks.push_back(chunk);
    }
    for (List& list : lists_) list.ticket = list.chunks.size();
}

// Threads that share work are pinned, each to a CPU of its own: measured, the system otherwise
// wakes workers on the loop's own CPU, where they only slow it down.
ThreadOptions ThreadPool::threadOptions(std::uint32_t worker) const {
    ThreadOptions thread{options_.name + (worker == 0 ? "-loop" : "-" + std::to_string(worker)),
                         options_.priority, options_.affinity};
    const bool sharesWork = threads() > 1 && threads() <= cpuCount(options_.affinity);
    if (options_.pin && (thread.priority != 0 || sharesWork)) {
        thread.affinity = {cpuForThread(options_.affinity, worker)};
    }
    return thread;
}

std::vector<int> ThreadPool::pinnedTo() const {
    std::vector<int> cpus;
    for (std::uint32_t worker = 0; worker < threads(); ++worker) {
        const std::vector<int> of = threadOptions(worker).affinity;
        if (of.size() == 1) cpus.push_back(of.front());
    }
    return cpus;
}

std::vector<std::string> ThreadPool::configureLoopThread() const {
    prefaultStack();
    return configureThisThread(threadOptions(0));
}

void ThreadPool::placeLoopThread(std::thread::native_handle_type loop) const {
    placeThread(loop, threadOptions(0).affinity);
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
    started_.publish(epoch_ + EventCount::step);
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
    std::uint32_t seen = 0;
    while (waitForCycle(seen)) takeChunks(worker);
}

// False: the pool stops. `seen`: the epoch that this worker was last woken for.
bool ThreadPool::waitForCycle(std::uint32_t& seen) noexcept {
    Spin spin(spinTime_);
    std::int64_t due = next_.load(std::memory_order_relaxed);
    for (;;) {
        const std::uint32_t epoch = started_.value();
        if (stopping_.load(std::memory_order_acquire)) return false;
        if (epoch != seen) {
            seen = epoch;
            return true;
        }
        if (spin.spend() || started_.sleepWhile(epoch, due)) continue;
        spin = Spin(spinTime_);
        due = 0;
    }
}

void ThreadPool::cycle(std::int64_t next) noexcept {
    if (threads() == 1) {
        setFloatingPointMode();
        for (std::uint32_t chunk = 0; chunk < chunks_.size(); ++chunk) {
            if (chunks_[chunk].count != 0) run_(context_, chunk, 0);
        }
        return;
    }
    epoch_ += EventCount::step;
    remaining_.store(static_cast<std::uint32_t>(chunks_.size()), std::memory_order_relaxed);
    for (List& list : lists_) {
        list.ticket.store(std::uint64_t{epoch_} << 32, std::memory_order_release);
    }
    next_.store(next, std::memory_order_relaxed);
    started_.publish(epoch_);
    takeChunks(0);
    for (Spin spin(spinTime_);;) {
        const std::uint32_t value = finished_.value();
        if (value == epoch_) return;
        if (spin.spend()) continue;
        countSleep(0);
        finished_.sleepWhile(value);
    }
}

bool ThreadPool::isReady(const Chunk& chunk, std::uint32_t epoch) const noexcept {
    const std::span before{predecessors_.data() + chunk.firstPredecessor, chunk.predecessorCount};
    return std::all_of(before.begin(), before.end(), [&](std::uint32_t each) {
        return done_[each].epoch.load(std::memory_order_seq_cst) == epoch;
    });
}

// Takes the first chunk of a list if it is ready, of the worker's own list first.
ThreadPool::Found ThreadPool::find(std::uint32_t worker) noexcept {
    Found found;
    for (std::uint32_t i = 0; i < threads(); ++i) {
        List& list = lists_[worker + i < threads() ? worker + i : worker + i - threads()];
        std::uint64_t ticket = list.ticket.load(std::memory_order_acquire);
        for (;;) {
            const auto next = static_cast<std::uint32_t>(ticket);
            const auto epoch = static_cast<std::uint32_t>(ticket >> 32);
            if (next >= list.chunks.size()) break;
            const std::uint32_t chunk = list.chunks[next];
            if (!isReady(chunks_[chunk], epoch)) {
                found.what = Found::What::Blocked;
                break;
            }
            if (list.ticket.compare_exchange_weak(ticket, ticket + 1, std::memory_order_acq_rel,
                                                  std::memory_order_acquire)) {
                return {Found::What::Taken, chunk, epoch};
            }
        }
    }
    return found;
}

// Runs chunks until none is left to take. A cycle cannot end before those taken here are reported
// in remaining_, so all of them belong to one epoch.
void ThreadPool::takeChunks(std::uint32_t worker) noexcept {
    setFloatingPointMode();
    std::uint32_t taken = 0;
    std::uint32_t epoch = 0;
    for (Spin spin(spinTime_);;) {
        Found found = find(worker);
        if (found.what == Found::What::Blocked && !spin.spend()) found = sleepOrFind(worker);
        if (found.what == Found::What::Nothing) break;
        if (found.what == Found::What::Blocked) continue;
        epoch = found.epoch;
        if (chunks_[found.chunk].count != 0) run_(context_, found.chunk, worker);
        if (isAwaited_[found.chunk]) complete(found.chunk, epoch);
        ++taken;
        spin = Spin(spinTime_);
    }
    if (taken != 0 && remaining_.fetch_sub(taken, std::memory_order_acq_rel) == taken) {
        finished_.publish(epoch);
    }
}

// Sequentially consistent with sleepOrFind(): either this sees the sleeper, or he the chunk.
void ThreadPool::complete(std::uint32_t chunk, std::uint32_t epoch) noexcept {
    done_[chunk].epoch.exchange(epoch, std::memory_order_seq_cst);
    if (sleepers_.load(std::memory_order_seq_cst) != 0) progress_.advance();
}

// Sleeps until some chunk is complete, unless one is ready by now.
ThreadPool::Found ThreadPool::sleepOrFind(std::uint32_t worker) noexcept {
    sleepers_.fetch_add(1, std::memory_order_seq_cst);
    const std::uint32_t value = progress_.value();
    const Found found = find(worker);
    if (found.what == Found::What::Blocked) {
        countSleep(worker);
        progress_.sleepWhile(value);
    }
    sleepers_.fetch_sub(1, std::memory_order_acq_rel);
    return found;
}

void ThreadPool::countSleep(std::uint32_t worker) noexcept {
    std::atomic<std::uint64_t>& sleeps = workers_[worker].sleeps;
    sleeps.store(sleeps.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
}

std::uint64_t ThreadPool::sleeps(std::uint32_t worker) const noexcept {
    return workers_[worker].sleeps.load(std::memory_order_relaxed);
}

}  // namespace cortex::cs
