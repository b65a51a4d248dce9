// SPDX-License-Identifier: Apache-2.0
// What a cluster takes of memory: over time, and by what it consists of (Fig. 18 to 22).
#include "measure/measurements.hpp"
#include "measure/memory_roles.hpp"
#include "report/statistics.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace cortex::profiler {
namespace {

constexpr double perSecond = 10;
constexpr double kilo = 1000;

std::vector<int> sizes(bool quick) {
    if (quick) return {100, 500, 1000};
    return {100, 200, 300, 400, 500, 600, 700, 800, 900, 1000};
}

double runSeconds(const RunOptions& options) { return options.quick ? 5 : 120; }

Quantity residualOf(const std::string& id, const std::string& what, const Line& line) {
    return {.id = id + "/linearity",
            .what = "largest distance of " + what + " from a straight line, of the whole range",
            .unit = "%",
            .value = 100 * line.residual,
            .aim = Aim::AtMost,
            .limit = 10,
            .paper = "linear"};
}

struct OverTime {
    std::vector<Series> allocated;  // kB over s, one of each size
    double growth = 0, allocations = 0;
    std::vector<Point> last;
};

// All sizes at once, each in a process of its own.
bool observe(const RunOptions& options, Progress& progress, OverTime& seen) {
    std::vector<std::unique_ptr<Child>> children;
    std::vector<MemorySample> first;
    const auto all = sizes(options.quick);
    for (const int size : all) {
        children.push_back(std::make_unique<Child>(
            wordsOf(MemoryRole{Content::Nothing, size, runSeconds(options), 8})));
        seen.allocated.push_back({std::to_string(size) + " simplexes", {}, false});
    }
    for (const auto& each : children) each->line();
    const int samples = static_cast<int>(runSeconds(options) * perSecond);
    for (int n = 0; n <= samples; ++n) {
        if (!progress.step(0.7 * n / samples, "memory over time")) break;
        seen.last.clear();
        for (std::size_t i = 0; i < children.size(); ++i) {
            const MemorySample now = sampleFrom(*children[i]);
            if (n == 0) first.push_back(now);
            seen.allocated[i].points.push_back({n / perSecond, now.allocated / kilo});
            seen.growth = std::max(seen.growth, now.allocated - first[i].allocated);
            seen.allocations = std::max(seen.allocations, now.allocations - first[i].allocations);
            seen.last.push_back({static_cast<double>(all[i]), now.allocated / kilo});
        }
    }
    return seen.last.size() == all.size();
}

void addOverTime(const RunOptions& options, OverTime& seen, Results& results) {
    const std::string time = std::to_string(static_cast<int>(runSeconds(options))) + " s";
    results.figures.push_back(
        {.id = "fig18-memory-over-time",
         .title = "Fig. 18: Memory over time",
         .paper = "100 to 1,000 empty simplexes over two minutes; no allocation",
         .setup = "A process for each number of simplexes, all at once at 1 kHz for " + time +
                  "; what its malloc has given out since before its types were read. The simplexes "
                  "are in "
                  "Standby, without items and outputs of their own.",
         .x = {"time", "s", false},
         .y = {"allocated", "kB", false},
         .series = std::move(seen.allocated),
         .marks = {}});
    results
        .add("memory/growth/allocated",
             "growth of what is allocated during " + time + " at 1 kHz, the worst of all sizes",
             "bytes", seen.growth)
        .atMost(0)
        .inPaper("0 over two minutes");
    results
        .add("memory/growth/allocations",
             "allocator calls of the loop's threads meanwhile, the worst of all sizes", "calls",
             seen.allocations)
        .atMost(0)
        .inPaper("0 over two minutes");
    const Line line = fit(seen.last);
    results.figures.push_back(
        {.id = "fig19-memory-simplexes",
         .title = "Fig. 19: Memory against empty simplexes",
         .paper = "Linear in the number of simplexes",
         .setup = "The last values of the figure before; 8 readers of images, 10 images.",
         .x = {"empty simplexes", "", false},
         .y = {"allocated", "kB", false},
         .series = {{"CorteX", seen.last, false}},
         .marks = {}});
    results.quantities.push_back(
        residualOf("memory/simplexes", "memory against empty simplexes", line));
}

MemorySample once(const MemoryRole& role) {
    Child child{wordsOf(role)};
    child.line();
    return sampleFrom(child);
}

// With all indexes and one image slot; the others are counted out.
void addEmptySimplex(Results& results) {
    constexpr int few = 1000, many = 11000;
    const MemorySample small = once({Content::Nothing, few, 0, 1});
    const MemorySample large = once({Content::Nothing, many, 0, 1});
    const double otherSlots = (large.images - 1) * (large.arena - small.arena);
    results
        .add("memory/simplex", "an empty simplex with all indexes and one image", "bytes",
             (large.allocated - small.allocated - otherSlots) / (many - few))
        .atMost(1024)
        .inPaper("linear");
}

struct Filling {
    Content content;
    const char *id, *figure, *title, *paper, *what;
};
constexpr Filling fillings[]{
    {Content::Data, "data", "fig20-memory-data", "Fig. 20: Memory against data items",
     "25 simplexes, 10 data items more in each at a time; linear", "a float"},
    {Content::Relationships, "relationships", "fig21-memory-relationships",
     "Fig. 21: Memory against relationships",
     "25 simplexes, 10 relationships more in each at a time; linear", "a relationship"},
    {Content::Commands, "commands", "fig22-memory-commands", "Fig. 22: Memory against commands",
     "25 simplexes, 10 commands more in each at a time; linear", "a command"}};

bool fill(const Filling& filling, const RunOptions& options, Progress& progress, Results& results) {
    std::vector<Point> points;
    for (int each = 0; each <= Loaded::most; each += options.quick ? 20 : 10) {
        if (!progress.step(0.75, filling.title)) return false;
        const MemorySample sample = once({filling.content, each, 0, 8});
        points.push_back({static_cast<double>(each), sample.allocated / kilo});
    }
    const Line line = fit(points);
    const std::string id = std::string{"memory/"} + filling.id;
    results.figures.push_back(
        {.id = filling.figure,
         .title = filling.title,
         .paper = filling.paper,
         .setup = "A process for each point; types, tables, indexes and 10 images included.",
         .x = {std::string{filling.id} + " in each of 25 simplexes", "", false},
         .y = {"allocated", "kB", false},
         .series = {{"CorteX", std::move(points), false}},
         .marks = {}});
    results
        .add(id,
             std::string{filling.what} + " in one of 25 simplexes of a type, 10 images included",
             "bytes", line.slope * kilo / Loaded::simplexes)
        .inPaper("linear");
    results.quantities.push_back(residualOf(id, std::string{"memory against "} + filling.id, line));
    return true;
}

double memorySeconds(const RunOptions& options) {
    return runSeconds(options) + (options.quick ? 10 : 40);
}

void runMemory(const RunOptions& options, Progress& progress, Results& results) {
    OverTime seen;
    const bool whole = observe(options, progress, seen);
    if (!seen.last.empty()) addOverTime(options, seen, results);
    if (!whole || !progress.step(0.7, "an empty simplex")) return;
    addEmptySimplex(results);
    for (const Filling& filling : fillings) {
        if (!fill(filling, options, progress, results)) return;
    }
    results.notes.push_back(
        "memory: bytes touched in a cycle are neither measured nor claimed, as the kernel tells of "
        "whole pages only");
    progress.step(1, "memory");
}

}  // namespace

Measurement memoryMeasurement() {
    return {"memory", "memory over time and by content (Fig. 18 to 22)", "Memory (Fig. 18 to 22)",
            memorySeconds, runMemory};
}

}  // namespace cortex::profiler
