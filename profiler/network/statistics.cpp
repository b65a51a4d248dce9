// SPDX-License-Identifier: Apache-2.0
#include "statistics.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include <unistd.h>

namespace cortex::network {

std::int64_t steadyNow() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

double percentile(std::vector<std::int64_t> values, double part) {
    if (values.empty()) return 0;
    const auto rank =
        static_cast<std::ptrdiff_t>(std::ceil(part * static_cast<double>(values.size())) - 1);
    const auto place = values.begin() + std::max<std::ptrdiff_t>(rank, 0);
    std::ranges::nth_element(values, place);
    return static_cast<double>(*place) * 1e-3;
}

double median(const std::vector<std::int64_t>& values) { return percentile(values, 0.5); }

std::string medianAndP99(const std::vector<std::int64_t>& values) {
    return text("median %.2f, ", median(values)) + text("p99 %.2f us", percentile(values, 0.99));
}

std::string medianAndWorst(const std::vector<std::int64_t>& values) {
    return text("median %.0f, ", median(values) * 1e-3) +
           text("worst %.0f ms", percentile(values, 1) * 1e-3);
}

void row(const std::string& what, const std::string& here, const std::string& beside,
         const std::string& aim) {
    std::printf("%-52s %-34s %-40s %s\n", what.c_str(), here.c_str(), beside.c_str(), aim.c_str());
    std::fflush(stdout);
}

void heading(const std::string& title) { std::printf("\n%s\n", title.c_str()); }

void progress(const std::string& what) {
    if (isatty(STDERR_FILENO) == 1) std::fprintf(stderr, "... %s\n", what.c_str());
}

std::string text(const char* format, double value) {
    char line[64];
    std::snprintf(line, sizeof line, format, value);
    return line;
}

}  // namespace cortex::network
