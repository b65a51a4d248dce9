// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "wire/messages.hpp"

#include <vector>

namespace cortex::comms {

// Ages that relationships have of their own are extras of the sample that their simplex is in.
// Writes those of the simplexes of a sample.
void writeAges(Model& sample);
// Gives the relationships of a sample the ages that its extras say. False: one of them names no
// relationship of the sample, or says no age.
bool readAges(std::vector<SimplexMessage>& simplexes, const std::vector<Extra>& extras);

}  // namespace cortex::comms
