// SPDX-License-Identifier: Apache-2.0
#include "measurements.hpp"

#include <array>

namespace cortex::profiler {

std::span<const Measurement> measurements() {
    static const std::array all{
        dutyMeasurement(),   intervalMeasurement(), latencyMeasurement(),
        jitterMeasurement(), commandsMeasurement(),
    };
    return all;
}

}  // namespace cortex::profiler
