// SPDX-License-Identifier: Apache-2.0
#include "threads/scheduler.hpp"

#include "cs/graphs.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace cortex::cs {
namespace {

using Indices = std::vector<std::uint32_t>;

std::vector<std::string> paths(const TaskGraph& graph, const Indices& order) {
    std::vector<std::string> result;
    for (const std::uint32_t node : order) result.push_back(graph.nodes[node].path);
    return result;
}

std::string loopMessage(const TaskGraph& graph) {
    try {
        canonicalOrder(graph);
    } catch (const LoopError& error) {
        return error.what();
    }
    return "";
}

Indices predecessorsOf(const Schedule& schedule, std::size_t chunk) {
    const auto* first = schedule.predecessors.data() + schedule.chunks[chunk].firstPredecessor;
    return {first, first + schedule.chunks[chunk].predecessorCount};
}

/// chunkOf[node], or -1 for nodes without a task; checks that the chunks tile the tasks.
std::vector<int> chunkOf(const TaskGraph& graph, const Schedule& schedule) {
    std::vector<int> result(graph.nodes.size(), -1);
    std::uint32_t next = 0;
    for (std::size_t chunk = 0; chunk < schedule.chunks.size(); ++chunk) {
        EXPECT_EQ(schedule.chunks[chunk].first, next);
        for (std::uint32_t i = 0; i < schedule.chunks[chunk].count; ++i) {
            const std::uint32_t node = schedule.tasks[next++];
            EXPECT_TRUE(graph.nodes[node].hasTask);
            EXPECT_EQ(result[node], -1) << graph.nodes[node].path << " is scheduled twice";
            result[node] = static_cast<int>(chunk);
        }
    }
    EXPECT_EQ(next, schedule.tasks.size());
    return result;
}

/// Every chunk that is certain to be complete before this one starts.
std::vector<std::vector<bool>> completeBefore(const Schedule& schedule) {
    const std::size_t count = schedule.chunks.size();
    std::vector<std::vector<bool>> complete(count, std::vector<bool>(count));
    for (std::size_t chunk = 0; chunk < count; ++chunk) {
        for (const std::uint32_t earlier : predecessorsOf(schedule, chunk)) {
            EXPECT_LT(earlier, chunk);
            complete[chunk][earlier] = true;
            for (std::size_t i = 0; i < count; ++i) {
                if (complete[earlier][i]) complete[chunk][i] = true;
            }
        }
    }
    return complete;
}

void expectKeepsOrder(const TaskGraph& graph, const Schedule& schedule) {
    const auto reaches = reachability(graph);
    const auto chunk = chunkOf(graph, schedule);
    const auto complete = completeBefore(schedule);
    Indices place(graph.nodes.size());
    for (std::uint32_t i = 0; i < schedule.tasks.size(); ++i) place[schedule.tasks[i]] = i;
    for (std::size_t before = 0; before < graph.nodes.size(); ++before) {
        ASSERT_EQ(chunk[before] >= 0, graph.nodes[before].hasTask);
        for (std::size_t after = 0; after < graph.nodes.size(); ++after) {
            if (!reaches[before][after] || chunk[before] < 0 || chunk[after] < 0) continue;
            const auto a = static_cast<std::size_t>(chunk[before]);
            const auto b = static_cast<std::size_t>(chunk[after]);
            ASSERT_TRUE(a == b ? place[before] < place[after] : complete[b][a])
                << graph.nodes[before].path << " -> " << graph.nodes[after].path;
        }
    }
}

TEST(Scheduler, OrdersByEdgesAndTiesByPath) {
    const TaskGraph graph = graphOf({"/d", "/c", "/b", "/a", "/e"}, {{0, 3}, {4, 2}});

    EXPECT_EQ(paths(graph, canonicalOrder(graph)),
              (std::vector<std::string>{"/c", "/d", "/a", "/e", "/b"}));
}

TEST(Scheduler, OrdersADiamondWithDuplicateEdges) {
    const TaskGraph graph =
        graphOf({"/join", "/right", "/left", "/fork"}, {{3, 1}, {3, 2}, {1, 0}, {2, 0}, {2, 0}});

    EXPECT_EQ(paths(graph, canonicalOrder(graph)),
              (std::vector<std::string>{"/fork", "/left", "/right", "/join"}));
}

TEST(Scheduler, CanonicalOrderDoesNotDependOnTheOrderOfNodesOrCosts) {
    const TaskGraph graph = graphOf({"/a", "/b", "-/c", "/d"}, {{3, 2}, {2, 0}});
    const TaskGraph shuffled = graphOf({"-/c", "/d", "/a", "/b"}, {{0, 2}, {1, 0}});
    const std::vector<double> costs = {9, 100, 0, 30};

    const Schedule plain = makeSchedule(graph, {});
    const Schedule costly =
        makeSchedule(shuffled, {.threads = 2, .costMicroseconds = costs, .force = true});

    EXPECT_EQ(paths(graph, plain.order), paths(shuffled, costly.order));
}

TEST(Scheduler, PrintsTheWholeLoopByPath) {
    const TaskGraph graph =
        graphOf({"/free", "/c", "/a", "/b", "/behind"}, {{0, 1}, {1, 2}, {2, 3}, {3, 1}, {3, 4}});

    const std::string message = loopMessage(graph);

    EXPECT_NE(message.find("/a -> /b -> /c -> /a"), std::string::npos) << message;
    EXPECT_NE(message.find("delayed=\"true\""), std::string::npos) << message;
    EXPECT_EQ(message.find("/free"), std::string::npos) << message;
    EXPECT_EQ(message.find("/behind"), std::string::npos) << message;
}

TEST(Scheduler, PrintsALoopThroughANodeWithoutTask) {
    const TaskGraph graph = graphOf({"/controller", "-/axis"}, {{0, 1}, {1, 0}});

    EXPECT_NE(loopMessage(graph).find("/axis -> /controller -> /axis"), std::string::npos);
}

TEST(Scheduler, PrintsANodeThatRunsBeforeItself) {
    EXPECT_NE(loopMessage(graphOf({"/a"}, {{0, 0}})).find("/a -> /a"), std::string::npos);
}

TEST(Scheduler, RefusesToScheduleALoop) {
    EXPECT_THROW(makeSchedule(graphOf({"/a", "/b"}, {{0, 1}, {1, 0}}), {}), LoopError);
}

TEST(Scheduler, SchedulesNothingForAnEmptyGraph) {
    const Schedule schedule = makeSchedule({}, {.threads = 4});

    EXPECT_TRUE(schedule.chunks.empty());
    EXPECT_EQ(schedule.threads, 1U);
}

TEST(Scheduler, MergesAChainIntoOneChunkEvenThroughNodesWithoutTask) {
    const TaskGraph graph =
        graphOf({"/a", "-/x", "/b", "-/y", "/c", "/other"}, {{0, 1}, {1, 2}, {2, 3}, {3, 4}});

    const Schedule schedule = makeSchedule(graph, {.threads = 2, .chunkSize = 1, .force = true});

    ASSERT_EQ(schedule.chunks.size(), 2U);
    EXPECT_EQ(schedule.tasks, (Indices{0, 2, 4, 5}));
    EXPECT_EQ(schedule.chunks[0].count, 3U);
    EXPECT_TRUE(schedule.predecessors.empty());
}

TEST(Scheduler, KeepsTheOrderThroughNodesWithoutTask) {
    const TaskGraph graph = graphOf({"/w1", "/w2", "-/axis", "-/copy", "/r1", "/r2"},
                                    {{0, 2}, {1, 2}, {2, 3}, {3, 4}, {3, 5}});

    const Schedule schedule = makeSchedule(graph, {.threads = 2, .chunkSize = 1, .force = true});

    ASSERT_EQ(schedule.chunks.size(), 4U);
    EXPECT_EQ(predecessorsOf(schedule, 2), (Indices{1, 0}));
    EXPECT_EQ(predecessorsOf(schedule, 3), (Indices{1, 0}));
}

TEST(Scheduler, DropsPredecessorsThatAnotherImplies) {
    const TaskGraph graph =
        graphOf({"/a", "/b", "/c", "/d", "/e"}, {{0, 1}, {0, 2}, {1, 3}, {2, 3}, {0, 3}, {0, 4}});

    const Schedule schedule = makeSchedule(graph, {.threads = 2, .chunkSize = 1, .force = true});

    const auto chunk = chunkOf(graph, schedule);
    Indices named = predecessorsOf(schedule, static_cast<std::size_t>(chunk[3]));
    std::sort(named.begin(), named.end());
    EXPECT_EQ(named, (Indices{static_cast<std::uint32_t>(chunk[1]),
                              static_cast<std::uint32_t>(chunk[2])}));
}

TEST(Scheduler, DoesNotMultiplyWritersByReaders) {
    constexpr std::uint32_t half = 20000;
    TaskGraph graph;
    graph.nodes.resize(2 * half + 1);
    for (std::uint32_t i = 0; i < graph.nodes.size(); ++i) {
        graph.nodes[i] = {"/n" + std::to_string(i), i != 2 * half, 1, 0};
    }
    for (std::uint32_t i = 0; i < half; ++i) {
        graph.edges.emplace_back(i, 2 * half);
        graph.edges.emplace_back(2 * half, half + i);
    }

    const Schedule schedule = makeSchedule(graph, {.threads = 2, .chunkSize = 1});

    EXPECT_EQ(schedule.tasks.size(), 2 * half);
    EXPECT_LE(schedule.predecessors.size(), 2 * half);
}

TEST(Scheduler, EveryChunkWaitsForAllThatRunsBeforeIt) {
    for (std::uint32_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(seed);
        const TaskGraph graph = randomGraph(seed);
        for (const std::uint32_t chunkSize : {0U, 1U, 3U, 8U}) {
            expectKeepsOrder(graph, makeSchedule(graph, {.threads = 4, .chunkSize = chunkSize}));
        }
    }
}

TEST(Scheduler, CutsLevelsByGivenCosts) {
    const TaskGraph graph = graphOf({"/a", "/b", "/c", "/d"}, {});
    const std::vector<double> costs = {100, 1, 1, 1};

    const Schedule schedule = makeSchedule(graph, {.threads = 2, .costMicroseconds = costs});

    ASSERT_EQ(schedule.chunks.size(), 2U);
    EXPECT_EQ(schedule.chunks[0].count, 1U);
    EXPECT_EQ(schedule.chunks[1].count, 3U);
}

TEST(Scheduler, UsesOneThreadForASmallGraph) {
    const TaskGraph graph = graphOf({"/a", "/b", "/c", "/d"}, {});

    EXPECT_EQ(makeSchedule(graph, {.threads = 4}).threads, 1U);
    EXPECT_EQ(makeSchedule(graph, {.threads = 4, .force = true}).threads, 4U);
}

TEST(Scheduler, UsesThreadsWhereTheCostIsWorthThem) {
    const TaskGraph graph = graphOf({"/a", "/b", "/c", "/d"}, {});
    const std::vector<double> costs = {100, 100, 100, 100};

    EXPECT_EQ(makeSchedule(graph, {.threads = 2, .costMicroseconds = costs}).threads, 2U);
    EXPECT_EQ(makeSchedule(graph, {.threads = 8, .costMicroseconds = costs}).threads, 4U);
}

TEST(Scheduler, UsesOneThreadUntilCostsAreMeasured) {
    TaskGraph graph;
    for (int i = 0; i < 20'000; ++i) graph.nodes.push_back({"/" + std::to_string(i), true, 1, 0});
    const ScheduleOptions unknown{.threads = 2};
    EXPECT_EQ(makeSchedule(graph, unknown).threads, 1U);

    std::vector<double> costs(graph.nodes.size(), 0.05);
    ScheduleOptions measured{.threads = 2, .costMicroseconds = costs};
    EXPECT_EQ(makeSchedule(graph, measured).threads, 2U);

    // 1,024 tasks of 17 ns are done before a second thread is awake. What was not measured does
    // not speak for one either.
    graph.nodes.resize(1024);
    costs.assign(1024, 0.017);
    measured.costMicroseconds = costs;
    EXPECT_EQ(makeSchedule(graph, measured).threads, 1U);
    costs.assign(1024, 0);
    EXPECT_EQ(makeSchedule(graph, measured).threads, 1U);
}

TEST(Scheduler, UsesOneThreadWhereNothingIsParallel) {
    const TaskGraph graph = graphOf({"/a", "/b", "/c"}, {{0, 1}, {1, 2}, {0, 2}});
    const std::vector<double> costs = {100, 100, 100};

    EXPECT_EQ(makeSchedule(graph, {.threads = 4, .costMicroseconds = costs}).threads, 1U);
}

// Many writers and many readers of simplexes without a task: joins, some of them a level of their
// own.
TEST(Scheduler, PlacesEveryChunkWithinItsLevelAlsoWhereNothingCosts) {
    TaskGraph graph;
    for (std::uint32_t i = 0; i < 22; ++i) {
        graph.nodes.push_back({"/" + std::to_string(i), i < 10 || i >= 12, 1, 0});
    }
    for (std::uint32_t join : {10U, 11U}) {
        for (std::uint32_t i = 0; i < 10; ++i) graph.edges.emplace_back(i, join);
        for (std::uint32_t i = 12; i < 22; ++i) graph.edges.emplace_back(join, i);
    }
    const Schedule schedule = makeSchedule(graph, {.threads = 4, .chunkSize = 1, .force = true});

    EXPECT_TRUE(std::ranges::any_of(schedule.chunks, [](const Chunk& c) { return c.count == 0; }));
    for (const Chunk& chunk : schedule.chunks) {
        EXPECT_GE(chunk.place, 0);
        EXPECT_LT(chunk.place, 1);
    }
}

TEST(Scheduler, KeepsTheOrderOfTasksWhateverTheyCost) {
    const TaskGraph graph = graphOf({"/a", "/b", "/c", "/d"}, {{0, 2}, {1, 3}, {0, 3}});
    const std::vector<double> costs = {1, 100, 40, 3};

    EXPECT_EQ(makeSchedule(graph, {.threads = 2, .costMicroseconds = costs}).tasks,
              makeSchedule(graph, {.threads = 2}).tasks);
}

TEST(Scheduler, WeighsATaskByItsRate) {
    TaskGraph graph = graphOf({"/a", "/b"}, {});
    const std::vector<double> costs = {60, 60};
    const ScheduleOptions options{.threads = 2, .costMicroseconds = costs};
    ASSERT_EQ(makeSchedule(graph, options).threads, 2U);

    graph.nodes[0].every = graph.nodes[1].every = 10;

    EXPECT_EQ(makeSchedule(graph, options).threads, 1U);
}

}  // namespace
}  // namespace cortex::cs
