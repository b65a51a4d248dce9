// SPDX-License-Identifier: Apache-2.0
#include "measurements.hpp"

#include "access.hpp"
#include "comms.hpp"
#include "endurance.hpp"
#include "memory.hpp"
#include "observers.hpp"
#include "scheduler_sweep.hpp"

#include <array>

namespace cortex::profiler {

std::span<const Measurement> measurements() {
    static const std::array all{
        memoryMeasurement(), dutyMeasurement(),      intervalMeasurement(),  latencyMeasurement(),
        jitterMeasurement(), commandsMeasurement(),  schedulerMeasurement(), accessMeasurement(),
        commsMeasurement(),  observersMeasurement(), enduranceMeasurement(),
    };
    return all;
}

}  // namespace cortex::profiler
