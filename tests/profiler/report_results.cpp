// SPDX-License-Identifier: Apache-2.0
#include "profiler/report_results.hpp"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace cortex::profiler {

namespace fs = std::filesystem;

Folder::Folder() {
    std::string name = (fs::temp_directory_path() / "cortex-report-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error{"no folder for the test"};
    path_ = name;
}

Folder::~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

std::string Folder::read(const std::string& file) const {
    std::ifstream stream{path_ / file, std::ios::binary};
    return {std::istreambuf_iterator<char>{stream}, {}};
}

void Folder::write(const std::string& file, const std::string& text) const {
    std::ofstream{path_ / file, std::ios::binary} << text;
}

Results sampleResults() {
    Results results;
    results.started = "2001-02-03 04:05:06 UTC";
    results.command = "cortex-profiler run all";
    results.version = "0.0.0";
    results.machine = {{"CPU", "one of a test"}, {"kernel", "Linux 1.2.3"}};
    results.notes = {"first note", "second \"note\", with a comma"};
    results.quantities = {{.id = "a/1",
                           .what = "first",
                           .unit = "ns",
                           .value = 1.0 / 3,
                           .repeats = {0.1, 0.2},
                           .baseline = 2.0 / 3,
                           .baselineName = "bare",
                           .aim = Aim::AtMost,
                           .limit = 0.5,
                           .paper = "Fig. 1"},
                          {.id = "a/2",
                           .what = "second",
                           .unit = "",
                           .value = 41234,
                           .aim = Aim::AtLeast,
                           .limit = 50000,
                           .lessIsBetter = false}};
    Figure figure;
    figure.id = "fig1-first";
    figure.title = "First";
    figure.paper = "Fig. 1: it grows.";
    figure.setup = "as it was run";
    figure.x = {"simplexes", "", true};
    figure.y = {"duty cycle", "%", false};
    figure.series = {{"p99", {{1, 0.1}, {10, 1.0 / 7}, {100, 3e-300}}, false},
                     {"bare, \"idle\"", {{1, 2}}, true}};
    figure.marks = {{Mark::Along::X, 50, "paper"}, {Mark::Along::Y, 0.2, "limit"}};
    results.figures = {figure};
    results.complete = true;
    return results;
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
        ++found;
    }
    return found;
}

}  // namespace cortex::profiler
