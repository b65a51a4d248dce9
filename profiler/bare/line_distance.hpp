// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <memory>
#include <thread>

namespace cortex::profiler {

// How long a cache line takes from one CPU to another and back, which tells whether the two have a
// cache in common: some 60 ns where they have, several hundred where they have not. A virtual
// machine's host may move its CPUs from one such neighbourhood to another at any time.
class LineDistance {
public:
    // Of the first two CPUs that this process may use; null where there is only one.
    static std::unique_ptr<LineDistance> ofFirstCpus();
    LineDistance(int cpu, int other);
    ~LineDistance();
    LineDistance(const LineDistance&) = delete;
    LineDistance& operator=(const LineDistance&) = delete;

    // Less than a millisecond on both CPUs. The least of several rounds, in ns.
    double measure();

private:
    void answer();

    int cpu_;
    std::atomic<int> asked_{0};  // measurements; negative: the end
    alignas(64) std::atomic<int> line_{0};
    std::thread other_;
};

}  // namespace cortex::profiler
