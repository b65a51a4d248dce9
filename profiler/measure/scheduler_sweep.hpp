// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "measure/measurement.hpp"

namespace cortex::profiler {

const Measurement& schedulerMeasurement();

}  // namespace cortex::profiler
