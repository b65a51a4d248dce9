// SPDX-License-Identifier: Apache-2.0
#include "threads/scheduler.hpp"

#include "threads/index_lists.hpp"

#include <algorithm>
#include <cassert>
#include <functional>
#include <limits>
#include <utility>

namespace cortex::cs {
namespace {

constexpr Index none = std::numeric_limits<Index>::max();

constexpr double chunkMicroseconds = 4.0;  // a ticket costs 0.05 to 0.2
constexpr double levelMicroseconds = 0.5;  // waiting for the chunks of the level before
constexpr std::size_t mostInlinedEdges = 64;
constexpr std::size_t mostPruningSteps = 1024;

// Builds a Schedule in the order of its public functions; used once.
class Builder {
public:
    Builder(const TaskGraph& graph, const ScheduleOptions& options)
        : graph_(graph), options_(options) {
        schedule_.order = canonicalOrder(graph);
    }

    void contract();
    void mergeChains();
    void cutChunks();
    void namePredecessors();
    Schedule finish();

private:
    std::size_t nodeCount() const { return graph_.nodes.size(); }
    double cost(Index node) const;
    double weight(Index node) const;
    std::vector<bool> leadingToTask(const Lists& successors) const;
    std::span<const Index> before(Index node) const;
    void cutLevel(std::span<const Index> chains);
    void openChunk();
    void placeChunks(std::size_t first, double levelCost);
    void addToOpenChunk(Index chain);
    void prune(Index chunk, std::vector<Index>& named, std::vector<Index>& coveredFor) const;

    const TaskGraph& graph_;
    const ScheduleOptions& options_;
    Schedule schedule_;

    // After contract(): what remains are tasks and joins, `before` names only such.
    std::vector<bool> remains_;
    std::vector<Index> beforeFirst_, beforeCount_, beforeItems_;

    // After mergeChains(): chains in the canonical order of their heads.
    std::vector<Index> chainOf_;  // by node, none where contracted
    Lists nodesOfChain_;
    std::vector<double> chainCost_, chainWeight_;
    Lists chainsOfLevel_;

    // While cutting; the open chunk is the last.
    std::vector<Index> chunkOfChain_;
    std::vector<double> chunkCost_;
    double openWeight_ = 0;
    bool openHoldsWholeLevels_ = false;
    double serialCost_ = 0, parallelCost_ = 0;
    Index widestLevel_ = 0;
};

// In microseconds.
double Builder::cost(Index node) const {
    if (!graph_.nodes[node].hasTask) return 0;
    const double full = options_.costMicroseconds.empty() ? assumedTaskMicroseconds
                                                          : options_.costMicroseconds[node];
    return std::max(full / std::max(1U, graph_.nodes[node].every), leastTaskMicroseconds);
}

// What fills a chunk: cost, or the number of tasks where the caller fixed it.
double Builder::weight(Index node) const {
    return options_.chunkSize == 0 ? cost(node) : graph_.nodes[node].hasTask ? 1 : 0;
}

std::span<const Index> Builder::before(Index node) const {
    return {beforeItems_.data() + beforeFirst_[node], beforeCount_[node]};
}

std::vector<bool> Builder::leadingToTask(const Lists& successors) const {
    std::vector<bool> leading(nodeCount());
    for (auto it = schedule_.order.rbegin(); it != schedule_.order.rend(); ++it) {
        const auto after = successors.of(*it);
        leading[*it] = graph_.nodes[*it].hasTask ||
                       std::any_of(after.begin(), after.end(), [&](Index i) { return leading[i]; });
    }
    return leading;
}

// Nodes without a task hand their predecessors on to their successors. Where that would multiply
// edges (many writers and many readers of one simplex) the node stays as a join, a task of no
// cost.
void Builder::contract() {
    const Lists successors = neighbours(graph_, true);
    const Lists predecessors = neighbours(graph_, false);
    const std::vector<bool> leading = leadingToTask(successors);
    std::vector<Index> seenFor(nodeCount(), none);
    remains_.assign(nodeCount(), false);
    beforeFirst_.assign(nodeCount(), 0);
    beforeCount_.assign(nodeCount(), 0);
    for (const Index node : schedule_.order) {
        beforeFirst_[node] = static_cast<Index>(beforeItems_.size());
        if (!leading[node]) continue;
        const auto add = [&](Index earlier) {
            if (std::exchange(seenFor[earlier], node) != node) beforeItems_.push_back(earlier);
        };
        for (const Index direct : predecessors.of(node)) {
            if (remains_[direct]) {
                add(direct);
            } else {
                const Index first = beforeFirst_[direct];
                for (Index i = first; i < first + beforeCount_[direct]; ++i) add(beforeItems_[i]);
            }
        }
        beforeCount_[node] = static_cast<Index>(beforeItems_.size()) - beforeFirst_[node];
        const std::size_t inlined = beforeCount_[node] * successors.of(node).size();
        remains_[node] =
            graph_.nodes[node].hasTask || (beforeCount_[node] > 1 && inlined > mostInlinedEdges);
    }
}

// A node whose only predecessor has no other successor continues its chain.
void Builder::mergeChains() {
    std::vector<Index> successorCount(nodeCount());
    for (const Index node : schedule_.order) {
        if (!remains_[node]) continue;
        for (const Index earlier : before(node)) ++successorCount[earlier];
    }
    chainOf_.assign(nodeCount(), none);
    std::vector<Index> members, chainOfMember, levelOfChain;
    Index levels = 0;
    for (const Index node : schedule_.order) {
        if (!remains_[node]) continue;
        const auto earlier = before(node);
        if (earlier.size() == 1 && successorCount[earlier[0]] == 1) {
            chainOf_[node] = chainOf_[earlier[0]];
        } else {
            Index level = 0;
            for (const Index i : earlier) level = std::max(level, levelOfChain[chainOf_[i]] + 1);
            chainOf_[node] = static_cast<Index>(levelOfChain.size());
            levelOfChain.push_back(level);
            chainCost_.push_back(0);
            chainWeight_.push_back(0);
            levels = std::max(levels, level + 1);
        }
        chainCost_[chainOf_[node]] += cost(node);
        chainWeight_[chainOf_[node]] += weight(node);
        members.push_back(node);
        chainOfMember.push_back(chainOf_[node]);
    }
    nodesOfChain_ = groupBy(chainOfMember, levelOfChain.size());
    for (Index& item : nodesOfChain_.items) item = members[item];
    chainsOfLevel_ = groupBy(levelOfChain, levels);
}

void Builder::openChunk() {
    schedule_.chunks.push_back({static_cast<Index>(schedule_.tasks.size()), 0, 0, 0});
    chunkCost_.push_back(0);
    openWeight_ = 0;
}

void Builder::addToOpenChunk(Index chain) {
    Chunk& chunk = schedule_.chunks.back();
    for (const Index node : nodesOfChain_.of(chain)) {
        if (!graph_.nodes[node].hasTask) continue;
        schedule_.tasks.push_back(node);
        ++chunk.count;
    }
    chunkOfChain_[chain] = static_cast<Index>(schedule_.chunks.size()) - 1;
    chunkCost_.back() += chainCost_[chain];
    openWeight_ += chainWeight_[chain];
}

// Small levels share a chunk; a large one is cut into chunks of its own. The chains of a level are
// independent of each other, so a chunk waits only for chunks of earlier levels.
void Builder::cutLevel(std::span<const Index> chains) {
    const double limit = options_.chunkSize != 0 ? options_.chunkSize : chunkMicroseconds;
    double levelCost = 0, levelWeight = 0;
    for (const Index chain : chains) {
        levelCost += chainCost_[chain];
        levelWeight += chainWeight_[chain];
    }
    const bool sharesChunk = openHoldsWholeLevels_ && openWeight_ + levelWeight <= limit;
    if (!sharesChunk) openChunk();
    const std::size_t firstChunk = schedule_.chunks.size() - 1;
    double largest = 0;
    bool isEmpty = !sharesChunk, isAfterJoin = false;
    for (const Index chain : chains) {
        const bool isJoin = chainWeight_[chain] <= 0;
        const bool isFull = openWeight_ + chainWeight_[chain] > limit;
        if (!isEmpty && (isFull || isJoin || isAfterJoin)) openChunk();
        addToOpenChunk(chain);
        largest = std::max(largest, chunkCost_.back());
        isEmpty = false;
        isAfterJoin = isJoin;
    }
    const auto width = static_cast<Index>(schedule_.chunks.size() - firstChunk);
    openHoldsWholeLevels_ = width == 1;
    placeChunks(firstChunk, levelCost);
    widestLevel_ = std::max(widestLevel_, width);
    serialCost_ += levelCost;
    const double shared = levelCost / std::max(1U, std::min(width, options_.threads));
    parallelCost_ += width == 1 ? levelCost : std::max(largest, shared) + levelMicroseconds;
}

// By the cost of those before them; a level of mere joins has none.
void Builder::placeChunks(std::size_t first, double levelCost) {
    constexpr double last = 0.9999;
    double before = 0;
    for (std::size_t i = first; levelCost > 0 && i < schedule_.chunks.size(); ++i) {
        schedule_.chunks[i].place = static_cast<float>(std::min(before / levelCost, last));
        before += chunkCost_[i];
    }
}

void Builder::cutChunks() {
    const auto levels = static_cast<Index>(chainsOfLevel_.first.size() - 1);
    chunkOfChain_.assign(chainCost_.size(), 0);
    for (Index level = 0; level < levels; ++level) cutLevel(chainsOfLevel_.of(level));
}

// Drops from `named` (latest first) what another of them names itself.
void Builder::prune(Index chunk, std::vector<Index>& named, std::vector<Index>& coveredFor) const {
    std::size_t steps = 0;
    std::erase_if(named, [&](Index earlier) {
        if (coveredFor[earlier] == chunk) return true;
        const Chunk& kept = schedule_.chunks[earlier];
        steps += kept.predecessorCount;
        if (steps > mostPruningSteps) return false;
        for (Index i = 0; i < kept.predecessorCount; ++i) {
            coveredFor[schedule_.predecessors[kept.firstPredecessor + i]] = chunk;
        }
        return false;
    });
}

void Builder::namePredecessors() {
    const std::size_t chunks = schedule_.chunks.size();
    const Lists chainsOfChunk = groupBy(chunkOfChain_, chunks);
    std::vector<Index> namedFor(chunks, none), coveredFor(chunks, none), named;
    for (Index chunk = 0; chunk < chunks; ++chunk) {
        named.clear();
        for (const Index chain : chainsOfChunk.of(chunk)) {
            const Index head = nodesOfChain_.of(chain).front();
            for (const Index node : before(head)) {
                const Index earlier = chunkOfChain_[chainOf_[node]];
                if (earlier == chunk || std::exchange(namedFor[earlier], chunk) == chunk) continue;
                assert(earlier < chunk);
                named.push_back(earlier);
            }
        }
        std::sort(named.begin(), named.end(), std::greater<>());
        prune(chunk, named, coveredFor);
        schedule_.chunks[chunk].firstPredecessor =
            static_cast<Index>(schedule_.predecessors.size());
        schedule_.chunks[chunk].predecessorCount = static_cast<Index>(named.size());
        schedule_.predecessors.insert(schedule_.predecessors.end(), named.begin(), named.end());
    }
}

Schedule Builder::finish() {
    const Index threads =
        options_.force ? options_.threads : std::min(options_.threads, widestLevel_);
    schedule_.threads = std::max<Index>(1, threads);
    const bool isMeasured = !options_.costMicroseconds.empty();
    const bool isWorthwhile = isMeasured && parallelCost_ + wakeMicroseconds < serialCost_;
    if (!isWorthwhile && !options_.force) schedule_.threads = 1;
    return std::move(schedule_);
}

}  // namespace

Schedule makeSchedule(const TaskGraph& graph, const ScheduleOptions& options) {
    assert(options.costMicroseconds.empty() ||
           options.costMicroseconds.size() == graph.nodes.size());
    Builder builder(graph, options);
    builder.contract();
    builder.mergeChains();
    builder.cutChunks();
    builder.namePredecessors();
    return builder.finish();
}

}  // namespace cortex::cs
