// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace cortex::network {

std::int64_t steadyNow();  // ns, the same for all processes of a host

// ns in, us out; 0 of none.
double percentile(std::vector<std::int64_t> values, double part);
double median(const std::vector<std::int64_t>& values);
std::string medianAndP99(const std::vector<std::int64_t>& values);    // "median 1.2, p99 3.4 us"
std::string medianAndWorst(const std::vector<std::int64_t>& values);  // the same in ms

// One line of the table; what is compared and the aim may be empty.
void row(const std::string& what, const std::string& here, const std::string& beside = {},
         const std::string& aim = {});
void heading(const std::string& title);
void progress(const std::string& what);  // on the error output, while it runs
std::string text(const char* format, double value);

}  // namespace cortex::network
