// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "measure/measurement.hpp"

namespace cortex::profiler {

Measurement memoryMeasurement();
Measurement dutyMeasurement();
Measurement intervalMeasurement();
Measurement latencyMeasurement();
Measurement jitterMeasurement();
Measurement commandsMeasurement();
Measurement schedulerMeasurement();
Measurement accessMeasurement();
Measurement commsMeasurement();
Measurement observersMeasurement();

}  // namespace cortex::profiler
