// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/registry.hpp"
#include "cortex/core/simplex_tree.hpp"

#include "options.hpp"

#include <string>

namespace cortex::toolkit {

// --dump-mjcf. The standard output is to have the model and nothing else, whatever plug-ins print.

// From now on the standard output of the process is its standard error. Returns the descriptor of
// the former one, for writeModel(). Throws Error.
int setStandardOutputAside();

// The text of the model that the command line asks for, as its simplex has it when it is populated.
// Nothing runs, and neither a network nor a device is talked to. Throws UsageError where the
// command line names no model or leaves open which, Error where there is none, ModelError where the
// system would not start.
std::string modelText(const CommandLine& line, const ClassRegistry& registry, SimplexTree& tree);

// All of it. Throws Error.
void writeModel(int descriptor, const std::string& text);

}  // namespace cortex::toolkit
