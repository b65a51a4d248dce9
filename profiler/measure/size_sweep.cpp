// SPDX-License-Identifier: Apache-2.0
#include "size_sweep.hpp"

#include "measure/memory_roles.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace cortex::profiler {
namespace {

double medianOf(std::vector<double> values) {
    std::ranges::sort(values);
    return values.empty() ? 0 : values[values.size() / 2];
}

void add(std::vector<Quantity>& to, int size, const char* part, const char* what, const char* unit,
         std::vector<double> repeats) {
    Quantity quantity{.id = "size/" + std::to_string(size) + "/" + part,
                      .what = std::to_string(size) + " empty simplexes: " + what,
                      .unit = unit,
                      .value = medianOf(repeats),
                      .repeats = std::move(repeats)};
    if (std::string{part} == "start" && size == 100'000) {
        quantity.aim = Aim::AtMost;
        quantity.limit = 2;
    }
    to.push_back(std::move(quantity));
}

}  // namespace

bool measureSizes(const RunOptions& options, Progress& progress, Results& results) {
    Series memory{"memory, kB", {}, false}, adding{"adding to the tree, ms", {}, false};
    Series starting{"start() to the first cycle, ms", {}, false}, cycle{"a cycle, us", {}, false};
    for (const int size : {100, 1'000, 10'000, 100'000}) {
        std::vector<double> adds, start, cycles, octets;
        for (int round = 0; round < (options.quick ? 1 : 3); ++round) {
            if (!progress.step(0.9, std::to_string(size) + " simplexes")) return false;
            Child child{sizeWords(size)};
            const SizeSample sample = sizeFrom(child);
            adds.push_back(sample.adding);
            start.push_back(sample.starting);
            cycles.push_back(sample.cycle * 1e-3);
            octets.push_back(sample.allocated);
        }
        const double x = size;
        memory.points.push_back({x, medianOf(octets) * 1e-3});
        adding.points.push_back({x, medianOf(adds) * 1e3});
        starting.points.push_back({x, medianOf(start) * 1e3});
        cycle.points.push_back({x, medianOf(cycles)});
        auto& all = results.quantities;
        add(all, size, "start", "from start() to the first cycle", "s", std::move(start));
        add(all, size, "adding", "reading types and adding to the tree", "s", std::move(adds));
        add(all, size, "cycle", "a cycle on one thread", "us", std::move(cycles));
        add(all, size, "memory", "allocated, 10 images included", "octets", std::move(octets));
    }
    results.figures.push_back(
        {.id = "size",
         .title = "Cost against size",
         .paper = "",
         .setup = "Empty simplexes on one thread, a process for each point.",
         .x = {"simplexes", "", true},
         .y = {"see legend", "", true},
         .series = {std::move(memory), std::move(adding), std::move(starting), std::move(cycle)},
         .marks = {}});
    return true;
}

}  // namespace cortex::profiler
