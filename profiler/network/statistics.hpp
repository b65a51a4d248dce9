// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace cortex::network {

std::int64_t steadyNow();  // ns, the same for all processes of a host

// ns in, us out; 0 of none.
double percentile(std::vector<std::int64_t> values, double part);
double median(const std::vector<std::int64_t>& values);

}  // namespace cortex::network
