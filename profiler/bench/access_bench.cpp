// SPDX-License-Identifier: Apache-2.0
// Access to data through a handle and by path in an image; the copy of an image of 10,000 items.
#include "subject/subject.hpp"

#include <cstring>
#include <vector>

#include <benchmark/benchmark.h>

namespace cortex::profiler {

namespace {

SimplexTree tenThousandItems() {
    SimplexTree tree{subjectTypes()};
    for (int i = 0; i < 1000; ++i) tree.add("/c" + std::to_string(i), "TenItems");
    return tree;
}

void throughAHandle(benchmark::State& state) {
    SubjectCluster bench{tenThousandItems(), {}};
    std::vector<Data<double>> handles;
    for (int i = 0; i < 1000; ++i) {
        handles.push_back(bench.tree.at("/c" + std::to_string(i)).data<double>("f3"));
    }
    for (auto _ : state) {
        for (Data<double>& item : handles) item = item + 1.0;
        benchmark::ClobberMemory();
    }
    state.counters["per_access"] =
        benchmark::Counter(static_cast<double>(state.iterations()) * 1000 * 2,
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void byPathInAnImage(benchmark::State& state) {
    SubjectCluster bench{tenThousandItems(), {}};
    const Image image = bench.cluster.image();
    std::vector<std::string> paths;
    for (int i = 0; i < 1000; ++i) paths.push_back("/c" + std::to_string(i));
    std::size_t next = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(image.get<double>(paths[next], "f3"));
        next = (next + 1) % paths.size();
    }
}

void imageOfTenThousandItems(benchmark::State& state) {
    SubjectCluster bench{tenThousandItems(), {}};
    ImagePool pool{bench.cluster.agent().tables(), 2};
    std::int64_t cycle = 0;
    for (auto _ : state) pool.publish(++cycle, 0, 0);
    state.counters["octets"] = static_cast<double>(bench.cluster.agent().tables().arena().size());
}

void memcpyOfTheSameSize(benchmark::State& state) {
    SubjectCluster bench{tenThousandItems(), {}};
    const auto arena = bench.cluster.agent().tables().arena();
    std::vector<std::byte> copy(arena.size());
    for (auto _ : state) {
        std::memcpy(copy.data(), arena.data(), arena.size());
        benchmark::ClobberMemory();
    }
}

BENCHMARK(throughAHandle);
BENCHMARK(byPathInAnImage);
BENCHMARK(imageOfTenThousandItems);
BENCHMARK(memcpyOfTheSameSize);

}  // namespace

}  // namespace cortex::profiler
