// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "models/model.hpp"

#include <span>

namespace cortex::cli {

// Compares what each system reads of another agent with what the others declare, and adds what it
// finds to the report of the one that reads. Pairs that are crossed go to the one that writes.
void checkRemotePaths(std::span<Model* const> systems);

}  // namespace cortex::cli
