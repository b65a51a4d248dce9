// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/registry.hpp"
#include "cortex/core/simplex_tree.hpp"

#include "options.hpp"

#include <functional>
#include <memory>

namespace cortex::toolkit {

using OwnedTree = std::unique_ptr<SimplexTree, void (*)(SimplexTree*)>;

// The system that the command line names, with its plug-ins loaded into `registry`, what its rules
// create, and the values that it starts with: of --settings, then what `restore` gives, then of
// --set. Throws ModelError, UsageError and Error.
OwnedTree readSystem(const CommandLine& line, ClassRegistry& registry,
                     const std::function<void(SimplexTree&)>& restore = {});

}  // namespace cortex::toolkit
