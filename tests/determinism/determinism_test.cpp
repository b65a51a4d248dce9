// SPDX-License-Identifier: Apache-2.0
// The tables and events of a system are a function of what enters it: the same for a plain serial
// reference and for 1, 2 and 4 threads, however long each task takes, and though the loop exchanges
// its plan for others while it runs.
#include "determinism/hand_made_loop.hpp"
#include "determinism/real_run.hpp"
#include "determinism/reference.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include <gtest/gtest.h>

namespace cortex::determinism {

namespace {

#if defined(__SANITIZE_ADDRESS__)
#define CORTEX_UNDER_SANITIZER
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer) || __has_feature(address_sanitizer)
#define CORTEX_UNDER_SANITIZER
#endif
#endif

#ifdef CORTEX_UNDER_SANITIZER
constexpr std::uint64_t usualSystems = 60;
#else
constexpr std::uint64_t usualSystems = 1000;
#endif
constexpr std::uint64_t shards = 4;
constexpr std::uint64_t mostAgain = 20;

// CORTEX_SYSTEMS: more of them for a long run.
std::uint64_t systemCount() {
    const char* text = std::getenv("CORTEX_SYSTEMS");
    const auto number = text != nullptr ? toInt(text) : std::nullopt;
    return number && *number > 0 ? static_cast<std::uint64_t>(*number) : usualSystems;
}

// How many systems have what.
struct Counts {
    std::uint64_t systems = 0, delayed = 0, shared = 0, rates = 0, faults = 0, across = 0;
    std::uint64_t handOvers = 0, all = 0, plans = 0, commands = 0, commandsAcross = 0, events = 0,
                  refused = 0, limited = 0;

    void add(const Plan& plan, const Observation& reference, std::uint64_t executed,
             std::uint64_t executedAcross, std::uint64_t plansOffered) {
        const auto count = [&](EventKind kind) {
            return static_cast<std::uint64_t>(
                std::ranges::count(reference.events, kind, &SeenEvent::kind));
        };
        const bool faulted = count(EventKind::Fault) > 0;
        ++systems;
        plans += plansOffered;
        delayed += plan.hasDelayedEdges();
        shared += plan.hasSharedSimplexes();
        rates += plan.hasRates();
        handOvers += plan.handsOver();
        faults += faulted;
        across += executedAcross > 0;
        all += plan.hasDelayedEdges() && plan.hasSharedSimplexes() && plan.hasRates() && faulted &&
               executedAcross > 0;
        commands += executed;
        commandsAcross += executedAcross;
        events += reference.events.size();
        refused += count(EventKind::Refusal);
        limited += count(EventKind::Limit);
    }
    void print() const {
        std::printf(
            "%llu systems: %llu have delayed edges, %llu two writers, %llu rates, %llu faults, "
            "%llu controllers that are handed over, "
            "%llu commands that crossed threads, %llu all of it\n"
            "  %llu commands along relationships (counted in three runs), %llu of them on another "
            "thread than sent; %llu events, among them %llu refusals, %llu limits; %llu plans "
            "exchanged while the loop ran\n",
            n(systems), n(delayed), n(shared), n(rates), n(faults), n(handOvers), n(across), n(all),
            n(commands), n(commandsAcross), n(events), n(refused), n(limited), n(plans));
    }
    static unsigned long long n(std::uint64_t number) { return number; }
};

class Determinism : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Determinism, HoldsForRandomSystemsOnOneTwoAndFourThreadsAgainstAPlainReference) {
    const std::uint64_t total = systemCount();
    const std::uint64_t first = GetParam() * total / shards;
    const std::uint64_t last = (GetParam() + 1) * total / shards;
    Counts counts;
    for (std::uint64_t seed = first + 1; seed <= last; ++seed) {
        const Plan plan = makePlan(seed);
        Reference reference{plan, testTypes()};
        const std::vector<NamedType> simplexes = reference.simplexes();
        const Observation expected = reference.run();
        std::uint64_t executed = 0, across = 0, plans = 0;
        // Which thread runs a task is chance, so a system runs again until a command has crossed.
        for (std::uint64_t run = 0; run < 3 || (across == 0 && run < 3 + mostAgain); ++run) {
            const std::uint32_t threads = run == 0 ? 1 : run == 1 ? 2 : 4;
            const std::uint64_t delays = run == 0 ? 0 : seed * 10 + threads + run * 1'000'000;
            const Observation seen = runOnThreads(plan, threads, delays);
            ASSERT_EQ(difference(simplexes, expected, seen), "")
                << "seed " << seed << " on " << threads << " threads";
            executed += seen.commandsExecuted;
            across += seen.commandsAcross;
            plans += seen.plansOffered;
        }
        counts.add(plan, expected, executed, across, plans);
    }
    counts.print();
    EXPECT_GE(counts.all * 10, counts.systems * 9);
    EXPECT_GE(counts.plans, counts.systems);
    EXPECT_GE(counts.handOvers * 3, counts.systems);
}

INSTANTIATE_TEST_SUITE_P(Shards, Determinism, testing::Range(std::uint64_t{0}, shards));

TEST(DeterminismReference, GivesTheSameInEveryOrderThatTheRelationshipsAllow) {
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        const Plan plan = makePlan(seed);
        Reference reference{plan, testTypes()};
        Reference other{plan, testTypes(), Reference::Merge::Canonical, seed};
        ASSERT_EQ(difference(reference.simplexes(), reference.run(), other.run()), "")
            << "seed " << seed;
    }
}

// Each receiver takes commands in the order in which they were sent, and tasks run in another order
// that the relationships allow: as a mailbox would that is no lane for each sender.
TEST(DeterminismIsCaughtMissing, WhereAMailboxIsMergedByArrival) {
    constexpr std::uint64_t systems = 100;
    std::uint64_t caught = 0;
    for (std::uint64_t seed = 1; seed <= systems; ++seed) {
        const Plan plan = makePlan(seed);
        Reference reference{plan, testTypes()};
        Reference wrong{plan, testTypes(), Reference::Merge::Arrival, seed};
        const std::vector<NamedType> simplexes = reference.simplexes();
        if (!difference(simplexes, reference.run(), wrong.run()).empty()) ++caught;
    }
    std::printf("a mailbox merged by arrival is caught in %d of %d systems\n",
                static_cast<int>(caught), static_cast<int>(systems));
    EXPECT_GE(caught * 4, systems);
}

#ifndef CORTEX_UNDER_SANITIZER  // it would report the race that is made here
TEST(DeterminismIsCaughtMissing, WhereTheScheduleLacksOneDependency) {
    int tried = 0, caught = 0;
    for (std::uint64_t seed = 3; tried < 12; seed += 3) {
        Plan plan = makePlan(seed);
        plan.late.clear();
        Reference reference{plan, testTypes()};
        const std::vector<NamedType> simplexes = reference.simplexes();
        const Observation expected = reference.run();
        ASSERT_EQ(difference(simplexes, expected, HandMadeLoop{plan}.run()), "") << "seed " << seed;

        HandMadeLoop spoiled{plan};
        if (!spoiled.dropDependency(seed)) continue;
        ++tried;
        if (!difference(simplexes, expected, spoiled.run()).empty()) ++caught;
    }
    std::printf("a dropped dependency is caught in %d of %d systems\n", caught, tried);
    EXPECT_GE(caught * 3, tried * 2);
}
#endif

}  // namespace

}  // namespace cortex::determinism
