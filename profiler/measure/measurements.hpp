// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "measure/measurement.hpp"

namespace cortex::profiler {

Measurement dutyMeasurement();
Measurement intervalMeasurement();
Measurement latencyMeasurement();
Measurement jitterMeasurement();
Measurement commandsMeasurement();

}  // namespace cortex::profiler
