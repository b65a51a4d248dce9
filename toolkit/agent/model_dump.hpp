// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "options.hpp"

namespace cortex::toolkit {

// --dump-mjcf: prints the model that the command line asks for, as its simplex has it when it is
// populated. Nothing runs, and neither a network nor a device is talked to. Throws UsageError where
// the command line names no model or leaves open which, Error where there is none, ModelError where
// the system would not start.
void dumpModel(const CommandLine& line);

}  // namespace cortex::toolkit
