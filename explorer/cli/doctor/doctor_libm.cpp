// SPDX-License-Identifier: Apache-2.0
#include "doctor/doctor.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include <gnu/libc-version.h>

namespace cortex::cli {
namespace {

using Level = Diagnosis::Level;

// FNV-1a over the bits of what the functions give that round differently with and without FMA.
// Public domain: http://www.isthe.com/chongo/tech/comp/fnv/
std::uint32_t bitsOfFunctions() {
    std::uint32_t hash = 2'166'136'261U;
    const auto add = [&hash](double value) {
        for (auto bits = std::bit_cast<std::uint64_t>(value); bits != 0; bits >>= 8U) {
            hash = (hash ^ static_cast<std::uint32_t>(bits & 0xffU)) * 16'777'619U;
        }
    };
    for (int i = 1; i <= 2'000; ++i) {
        const volatile double step = 0.000'37;  // so that the compiler computes nothing itself
        const double x = step * i;
        for (const double value : {std::sin(9 * x), std::cos(9 * x), std::tan(x), std::exp(x),
                                   std::log(x), std::pow(x, 1.7), std::atan2(x, 0.3), std::asin(x)})
            add(value);
    }
    return hash;
}

}  // namespace

void examineLibm(Diagnoses& found) {
    char text[120];
    std::snprintf(text, sizeof text,
                  "glibc %s, variant %08x: results agree bit for bit only where this is the same",
                  gnu_get_libc_version(), bitsOfFunctions());
    found.push_back({Level::Ok, "libm", text, ""});
}

}  // namespace cortex::cli
