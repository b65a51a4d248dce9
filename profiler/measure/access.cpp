// SPDX-License-Identifier: Apache-2.0
// Access to data through a handle and by path in an image.
#include "baselines/in_turn.hpp"
#include "measure/measurements.hpp"
#include "subject/subject.hpp"

#include <string>
#include <vector>

namespace cortex::profiler {
namespace {

constexpr int simplexes = 1000;  // of ten items

void use(double value) { asm volatile("" : : "x"(value)); }
void forget() { asm volatile("" : : : "memory"); }

std::string pathOf(int number) { return "/c" + std::to_string(number); }

SimplexTree tenThousandItems() {
    SimplexTree tree{subjectTypes()};
    for (int i = 0; i < simplexes; ++i) tree.add(pathOf(i), "TenItems");
    return tree;
}

// All of them read and written once in a round.
Contender throughHandles(SubjectCluster& subject) {
    std::vector<Data<double>> handles;
    for (int i = 0; i < simplexes; ++i) {
        handles.push_back(subject.tree.at(pathOf(i)).data<double>("f3"));
    }
    return {"handle", [handles](std::int64_t cycles) mutable {
                return timed([&] {
                    for (std::int64_t i = 0; i < cycles; ++i) {
                        for (Data<double>& item : handles) item = item + 1.0;
                        forget();
                    }
                });
            }};
}

Contender throughPointers(std::vector<double>& values) {
    return {"pointer", [&values](std::int64_t cycles) {
                std::vector<double*> all;
                for (std::size_t i = 0; i < values.size(); i += 10) all.push_back(&values[i]);
                return timed([&] {
                    for (std::int64_t i = 0; i < cycles; ++i) {
                        for (double* item : all) *item = *item + 1.0;
                        forget();
                    }
                });
            }};
}

Contender byPath(const Image& image) {
    std::vector<std::string> paths;
    for (int i = 0; i < simplexes; ++i) paths.push_back(pathOf(i));
    return {"path", [&image, paths](std::int64_t cycles) {
                return timed([&] {
                    for (std::int64_t i = 0; i < cycles; ++i) {
                        for (const std::string& path : paths) use(image.get<double>(path, "f3"));
                    }
                });
            }};
}

Quantity quantityOf(const char* id, const char* what, const Contender& from, double parts,
                    double limit) {
    Quantity quantity{.id = id,
                      .what = what,
                      .unit = "ns",
                      .value = from.best() / parts,
                      .repeats = from.rounds,
                      .aim = Aim::AtMost,
                      .limit = limit};
    for (double& each : quantity.repeats) each /= parts;
    return quantity;
}

void measureItems(const Rounds& rounds, Results& results) {
    SubjectCluster subject{tenThousandItems(), {}};
    const Image image = subject.cluster.image();
    std::vector<double> values(10 * simplexes);
    std::vector<Contender> all{throughHandles(subject), byPath(image), throughPointers(values)};
    measureInTurn(all, rounds);
    Quantity handle = quantityOf("access/handle",
                                 "one item through a handle: a read or a write, best of 5 rounds",
                                 all[0], 2 * simplexes, 1);
    handle.baseline = all[2].best() / (2 * simplexes);
    handle.baselineName = "plain pointers";
    results.quantities.push_back(std::move(handle));
    results.quantities.push_back(
        quantityOf("access/path", "one item by path and name in an image, best of 5 rounds", all[1],
                   simplexes, 100));
}

void runAccess(const RunOptions& options, Progress& progress, Results& results) {
    const Rounds rounds{5, options.quick ? 0.05 : 0.3};
    if (!progress.step(0, "items")) return;
    measureItems(rounds, results);
    progress.step(1, "access");
}

}  // namespace

Measurement accessMeasurement() {
    return {"access", "data through a handle and by path in an image", "Access to data",
            [](const RunOptions& options) { return options.quick ? 2.0 : 10.0; }, runAccess};
}

}  // namespace cortex::profiler
