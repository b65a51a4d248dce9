// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/value.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace cortex::determinism {

// Splitmix64: the only source of chance here. The same seed gives the same in every run of a build.
class Chance {
public:
    explicit Chance(std::uint64_t seed) : state_{seed} {}

    std::uint64_t next();
    std::uint64_t below(std::uint64_t bound) { return next() % bound; }
    bool oneIn(std::uint64_t n) { return below(n) == 0; }
    double between(double low, double high);
    // Makes what follows depend on `bits` too.
    void mix(std::uint64_t bits);

private:
    std::uint64_t state_;
};

// A command that a task may send along one of its relationships.
struct SenderPlan {
    std::size_t relation;
    std::string command;
    std::uint32_t capacity;
};
// Life-cycle commands along one of its relationships.
struct LifePlan {
    std::size_t relation;
    bool manage;
};
struct RelationPlan {
    std::string rule, target;
    bool delayed;
};
struct SimplexPlan {
    std::string path, type;
    bool task = false;
    std::uint64_t seed = 0;
    bool wild = false;  // throws, faults and writes nonsense now and then
    int every = 1, phase = -1;
    std::vector<RelationPlan> relations;
    std::vector<SenderPlan> senders;
    std::vector<LifePlan> lives;
    std::vector<std::size_t> choices;  // relationships to what it hands demands over between
};

struct OutsideCommandPlan {
    std::int64_t tick;  // handed over in the first cycle not before this one
    std::string sender, path, command;
    std::map<std::string, Value> arguments;
    std::int64_t budget;  // cycles until it expires
};
struct LatePlan {
    std::int64_t cycle;  // of step(); the cycle takes so much longer
    std::int64_t periods;
};

enum class OverflowPlan : std::uint8_t { Skip, CatchUp, Halt };

// A random system and everything that will enter it: the same seed gives the same plan.
struct Plan {
    std::uint64_t seed = 0;
    std::vector<SimplexPlan> simplexes;      // in random order, not that of their paths
    std::vector<OutsideCommandPlan> script;  // by tick, in the order of handing over
    std::vector<LatePlan> late;
    OverflowPlan overflow = OverflowPlan::Skip;
    std::uint32_t catchUpCycles = 3;
    std::uint32_t chunkSize = 0;

    bool hasDelayedEdges() const;
    bool hasSharedSimplexes() const;
    bool hasRates() const;
    bool handsOver() const;
};

inline constexpr std::int64_t steps = 200;
inline constexpr std::int64_t snapshotEvery = 10;
inline constexpr std::int64_t period = 1'000'000;  // ns
inline constexpr std::size_t mostSimplexes = 64;

Plan makePlan(std::uint64_t seed);

}  // namespace cortex::determinism
