// SPDX-License-Identifier: Apache-2.0
#include "distances.hpp"

#include "report/number_text.hpp"
#include "threads/line_distance.hpp"

#include <algorithm>

namespace cortex::profiler {

void Distances::look() {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return;
    next_ = now + std::chrono::seconds{1};
    const double line = cs::lineMicroseconds({}, 2);
    if (line > 0) nanoseconds_.push_back(line * 1e3);
}

void Distances::add(const std::string& id, const std::string& what, Results& results) const {
    if (nanoseconds_.empty()) return;
    constexpr double farther = 3;
    std::vector<double> sorted = nanoseconds_;
    std::ranges::sort(sorted);
    results.quantities.push_back({.id = id + "/line",
                                  .what = what + ": a cache line from one CPU to the next and back",
                                  .unit = "ns",
                                  .value = sorted[sorted.size() / 2],
                                  .repeats = nanoseconds_});
    const auto apart =
        std::ranges::count_if(sorted, [&](double each) { return each > farther * sorted.front(); });
    if (apart == 0) return;
    results.notes.push_back("While " + what + " ran, a cache line took up to " +
                            fixed(sorted.back(), 0) + " ns from one CPU to the next and back in " +
                            std::to_string(apart) + " of " + std::to_string(sorted.size()) +
                            " seconds, else " + fixed(sorted.front(), 0) +
                            " ns: the two had no cache in common then, as where the host of a "
                            "virtual machine moves them, and loops take longer.");
}

}  // namespace cortex::profiler
