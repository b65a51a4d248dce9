// SPDX-License-Identifier: Apache-2.0
#include "threads/thread_pool.hpp"

#include "cortex/core/agent.hpp"

#include "cs/graphs.hpp"
#include "support/patience.hpp"
#include "threads/realtime_thread.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cfenv>
#include <chrono>
#include <random>
#include <set>
#include <stdexcept>
#include <thread>
#include <tuple>

#include <gtest/gtest.h>

namespace cortex::cs {
namespace {

using namespace std::chrono_literals;
using Indices = std::vector<std::uint32_t>;

void waitUntil(const auto& condition) {
    const auto end = std::chrono::steady_clock::now() + test::patience;
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) throw std::runtime_error("waits in vain");
        std::this_thread::yield();
    }
}

/// Calls its function with (chunk, worker).
template <typename Function>
struct Chunks {
    Function function;

    static void run(void* self, std::uint32_t chunk, std::uint32_t worker) {
        static_cast<Chunks*>(self)->function(chunk, worker);
    }
};

/// Tasks that note the cycle in which they ran and check that all before them ran in it already.
/// What they read of each other is no atomic, so that ThreadSanitizer sees a missing order too.
class OrderCheck {
public:
    OrderCheck(const TaskGraph& graph, const Schedule& schedule)
        : schedule_(schedule), before_(graph.nodes.size()), records_(graph.nodes.size()) {
        const auto reaches = reachability(graph);
        for (const std::uint32_t from : schedule.tasks) {
            for (const std::uint32_t to : schedule.tasks) {
                if (reaches[from][to]) before_[to].push_back(from);
            }
        }
    }

    void nextCycle() { ++cycle_; }

    void runChunk(std::uint32_t index) {
        const Chunk& chunk = schedule_.chunks[index];
        for (std::uint32_t i = 0; i < chunk.count; ++i) runTask(schedule_.tasks[chunk.first + i]);
    }

    static void run(void* self, std::uint32_t chunk, std::uint32_t) {
        static_cast<OrderCheck*>(self)->runChunk(chunk);
    }

    bool allRanOnce() const {
        return std::all_of(schedule_.tasks.begin(), schedule_.tasks.end(), [&](std::uint32_t i) {
            return records_[i].runs.load() == cycle_ && records_[i].cycle.load() == cycle_;
        });
    }

    std::uint32_t violations() const { return violations_.load(); }

private:
    struct Record {
        std::atomic<std::uint32_t> cycle{0}, runs{0};
        std::uint64_t value = 0;
    };

    void runTask(std::uint32_t node) {
        delay(node);
        std::uint64_t sum = node;
        for (const std::uint32_t earlier : before_[node]) {
            if (records_[earlier].cycle.load(std::memory_order_relaxed) == cycle_) {
                sum += records_[earlier].value;
            } else {
                ++violations_;
            }
        }
        records_[node].value = sum;
        records_[node].cycle.store(cycle_, std::memory_order_relaxed);
        records_[node].runs.fetch_add(1, std::memory_order_relaxed);
    }

    /// Mostly none, sometimes about a microsecond, seldom longer than a waiting thread spins.
    void delay(std::uint32_t node) const {
        const std::uint32_t mixed = (node * 2654435761U) ^ (cycle_ * 2246822519U);
        const std::uint32_t turns = mixed % 509 == 0 ? 8000 : mixed % 7 == 0 ? 100 : 0;
        std::atomic<std::uint32_t> turned{0};
        while (turned.fetch_add(1, std::memory_order_relaxed) < turns) {
        }
    }

    const Schedule& schedule_;
    std::vector<Indices> before_;
    std::vector<Record> records_;
    std::atomic<std::uint32_t> violations_{0};
    std::uint32_t cycle_ = 0;
};

Schedule flatSchedule(std::uint32_t chunks, std::uint32_t threads) {
    TaskGraph graph;
    for (std::uint32_t i = 0; i < chunks; ++i) {
        graph.nodes.push_back({"/" + std::to_string(i), true, 1, 0});
    }
    return makeSchedule(graph, {.threads = threads, .chunkSize = 1, .force = true});
}

/// Each task runs after two of the layer before.
TaskGraph layeredGraph(std::uint32_t width, std::uint32_t layers) {
    TaskGraph graph;
    for (std::uint32_t i = 0; i < width * layers; ++i) {
        graph.nodes.push_back({"/" + std::to_string(i), true, 1, 0});
        if (i < width) continue;
        graph.edges.emplace_back(i - width, i);
        graph.edges.emplace_back(i / width * width - width + (i + 1) % width, i);
    }
    return graph;
}

/// /a before /b and /c; so no chain is merged.
Schedule forkSchedule() {
    return makeSchedule(graphOf({"/a", "/b", "/c"}, {{0, 1}, {0, 2}}),
                        {.threads = 2, .chunkSize = 1, .force = true});
}

class ThreadPoolOrder
    : public ::testing::TestWithParam<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> {};

TEST_P(ThreadPoolOrder, RunsEachTaskOncePerCycleAfterAllBeforeIt) {
    const auto [threads, chunkSize, spin] = GetParam();
    for (std::uint32_t seed = 0; seed < 40; ++seed) {
        SCOPED_TRACE(seed);
        const TaskGraph graph = randomGraph(seed);
        const Schedule schedule =
            makeSchedule(graph, {.threads = threads, .chunkSize = chunkSize, .force = true});
        OrderCheck check(graph, schedule);
        ThreadPool pool(schedule, &OrderCheck::run, &check, {.spinMicroseconds = spin});
        ASSERT_EQ(pool.threads(), schedule.tasks.empty() ? 1 : threads);

        for (int cycle = 0; cycle < 200; ++cycle) {
            check.nextCycle();
            pool.cycle();
            ASSERT_TRUE(check.allRanOnce());
        }

        EXPECT_EQ(check.violations(), 0U);
    }
}

INSTANTIATE_TEST_SUITE_P(Threads, ThreadPoolOrder,
                         ::testing::Combine(::testing::Values(1U, 2U, 4U),
                                            ::testing::Values(1U, 8U, 0U),
                                            ::testing::Values(0U, 20U)),
                         [](const auto& test) {
                             return std::to_string(std::get<0>(test.param)) + "Chunk" +
                                    std::to_string(std::get<1>(test.param)) + "Spin" +
                                    std::to_string(std::get<2>(test.param));
                         });

/// Holds /a back until another chunk ran: impossible unless the schedule lost an edge.
TEST(ThreadPool, IsCaughtByTheOrderCheckIfAPredecessorIsLost) {
    const TaskGraph graph = graphOf({"/a", "/b", "/c"}, {{0, 1}, {0, 2}});
    Schedule schedule = forkSchedule();
    ASSERT_EQ(schedule.chunks[1].predecessorCount, 1U);
    schedule.chunks[1].predecessorCount = 0;
    OrderCheck check(graph, schedule);
    std::atomic<bool> secondRan{false};
    Chunks chunks{[&](std::uint32_t chunk, std::uint32_t) {
        if (chunk == 0) waitUntil([&] { return secondRan.load(); });
        check.runChunk(chunk);
        if (chunk == 1) secondRan = true;
    }};
    ThreadPool pool(schedule, &decltype(chunks)::run, &chunks, {});

    check.nextCycle();
    pool.cycle();

    EXPECT_EQ(check.violations(), 1U);
}

TEST(ThreadPool, RunsOneThreadInScheduleOrderOnTheCallingThread) {
    const Schedule schedule = flatSchedule(5, 1);
    Indices order;
    std::set<std::thread::id> threads;
    Chunks chunks{[&](std::uint32_t chunk, std::uint32_t worker) {
        EXPECT_EQ(worker, 0U);
        order.push_back(chunk);
        threads.insert(std::this_thread::get_id());
    }};
    ThreadPool pool(schedule, &decltype(chunks)::run, &chunks, {});

    pool.cycle();

    EXPECT_EQ(order, (Indices{0, 1, 2, 3, 4}));
    EXPECT_EQ(threads, std::set{std::this_thread::get_id()});
}

TEST(ThreadPool, ReturnsAtOnceWithoutChunks) {
    Chunks chunks{[](std::uint32_t, std::uint32_t) { FAIL(); }};
    ThreadPool pool(Schedule{}, &decltype(chunks)::run, &chunks, {.threads = 4});

    pool.cycle();

    EXPECT_EQ(pool.threads(), 1U);
}

std::int64_t fromNow(std::chrono::nanoseconds time) {
    return (std::chrono::steady_clock::now().time_since_epoch() + time).count();
}

/// The chunks of a cycle wait for each other, so no cycle ends unless all workers come: whether
/// they are told nothing of the next cycle, or that it is due, was, or will be long after it is.
TEST(ThreadPool, WakesEachWorkerInEachCycle) {
    constexpr std::uint32_t threadCount = 4;
    constexpr std::array<std::chrono::nanoseconds, 4> delays{0ns, -1ms, 50us, 1h};
    const Schedule schedule = flatSchedule(threadCount, threadCount);
    std::atomic<std::uint32_t> arrived{0};
    std::uint32_t expected = 0;
    Chunks chunks{[&](std::uint32_t, std::uint32_t) {
        ++arrived;
        waitUntil([&] { return arrived.load() >= expected; });
    }};
    for (const std::uint32_t spin : {0U, 20U}) {
        ThreadPool pool(schedule, &decltype(chunks)::run, &chunks, {.spinMicroseconds = spin});
        for (std::size_t cycle = 0; cycle < 500; ++cycle) {
            const std::chrono::nanoseconds due = delays[cycle % delays.size()];
            const std::int64_t next = due == 0ns ? 0 : fromNow(due);
            expected += threadCount;
            pool.cycle(next);
            if (due == 50us) waitUntil([&] { return fromNow(0ns) >= next; });
        }
    }
    EXPECT_EQ(arrived.load(), expected);
}

/// /a goes on only after the thread that waits for it sleeps.
TEST(ThreadPool, SleepsInsteadOfSpinningForever) {
    ThreadPool* running = nullptr;
    std::uint64_t cycles = 0;
    const auto sleeps = [&] { return running->sleeps(0) + running->sleeps(1); };
    Chunks chunks{[&](std::uint32_t chunk, std::uint32_t) {
        if (chunk == 0) waitUntil([&] { return sleeps() >= cycles; });
    }};
    ThreadPool pool(forkSchedule(), &decltype(chunks)::run, &chunks, {});
    running = &pool;

    for (cycles = 1; cycles <= 50; ++cycles) pool.cycle();

    EXPECT_GE(sleeps(), 50U);
}

/// The worker's chunk goes on only after the loop thread sleeps at the end of its cycle.
TEST(ThreadPool, SleepsAtTheEndOfACycleToo) {
    ThreadPool* running = nullptr;
    std::atomic<bool> workerTookOne{false};
    Chunks chunks{[&](std::uint32_t, std::uint32_t worker) {
        if (worker == 0) {
            waitUntil([&] { return workerTookOne.load(); });
        } else {
            workerTookOne = true;
            waitUntil([&] { return running->sleeps(0) > 0; });
        }
    }};
    ThreadPool pool(flatSchedule(2, 2), &decltype(chunks)::run, &chunks, {});
    running = &pool;

    pool.cycle();

    EXPECT_GE(pool.sleeps(0), 1U);
}

TEST(ThreadPool, CallsTheStartHookInEachWorkerBeforeItsFirstCycle) {
    struct Started {
        std::array<std::thread::id, 3> threads;

        static void note(void* self, std::uint32_t worker) {
            static_cast<Started*>(self)->threads.at(worker) = std::this_thread::get_id();
        }
    } started;
    std::atomic<std::uint32_t> others{0};
    Chunks chunks{[&](std::uint32_t, std::uint32_t worker) {
        if (worker != 0 && started.threads[worker] != std::this_thread::get_id()) ++others;
    }};
    ThreadPool pool(flatSchedule(30, 3), &decltype(chunks)::run, &chunks,
                    {.onStart = &Started::note, .onStartContext = &started});

    EXPECT_EQ(started.threads[0], std::thread::id());
    EXPECT_NE(started.threads[1], std::thread::id());
    EXPECT_NE(started.threads[2], started.threads[1]);
    pool.cycle();
    EXPECT_EQ(others.load(), 0U);
}

/// A task that changes the rounding cannot change another thread's results in the next cycle.
TEST(ThreadPool, SetsTheFloatingPointModeOfEachThreadInEachCycle) {
    for (const std::uint32_t threads : {1U, 2U}) {
        std::atomic<std::uint32_t> arrived{0}, wrong{0};
        std::uint32_t expected = 0;
        Chunks chunks{[&](std::uint32_t, std::uint32_t) {
            volatile double one = 1.0, tiny = 1e-20;
            if (one + tiny != 1.0) ++wrong;
            std::fesetround(FE_UPWARD);
            ++arrived;
            waitUntil([&] { return arrived.load() >= expected; });
        }};
        ThreadPool pool(flatSchedule(threads, threads), &decltype(chunks)::run, &chunks, {});
        for (int cycle = 0; cycle < 10; ++cycle) {
            expected += threads;
            pool.cycle();
        }
        setFloatingPointMode();
        EXPECT_EQ(wrong.load(), 0U);
    }
}

TEST(ThreadPool, UsesNoMoreRealtimeThreadsThanCpus) {
    const std::uint32_t cpus = cpuCount({});
    Chunks chunks{[](std::uint32_t, std::uint32_t) {}};
    const Schedule schedule = flatSchedule(cpus + 1, cpus + 1);
    ThreadPool pool(schedule, &decltype(chunks)::run, &chunks, {.priority = 1});

    EXPECT_EQ(pool.threads(), cpus);
    ASSERT_FALSE(pool.report().empty());
    EXPECT_NE(pool.report()[0].find("fewer threads"), std::string::npos) << pool.report()[0];
}

/// Spinning without bound hangs here: a spinner of the same priority never leaves the CPU to the
/// thread that it waits for.
TEST(ThreadPool, EndsEveryCycleWithMoreRealtimeThreadsThanCpusWhenATaskBlocks) {
    const std::uint32_t threads = 2 * cpuCount({});
    const TaskGraph graph = layeredGraph(2 * threads, 5);
    const Schedule schedule = makeSchedule(graph, {threads, 1, {}, true});
    OrderCheck check(graph, schedule);
    Chunks chunks{[&](std::uint32_t chunk, std::uint32_t) {
        if (chunk % 5 == 1) std::this_thread::sleep_for(std::chrono::microseconds(100));
        check.runChunk(chunk);
    }};
    std::vector<std::string> refused;
    int cycles = 0;
    std::thread loop([&] {
        ThreadPool pool(schedule, &decltype(chunks)::run, &chunks,
                        {.priority = 10, .oversubscribe = true});
        refused = pool.configureLoopThread();
        for (; refused.empty() && cycles < 200; ++cycles) {
            check.nextCycle();
            pool.cycle();
            if (!check.allRanOnce()) break;
        }
    });
    loop.join();
    if (!refused.empty()) GTEST_SKIP() << refused[0];

    EXPECT_EQ(cycles, 200);
    EXPECT_EQ(check.violations(), 0U);
}

}  // namespace
}  // namespace cortex::cs
