// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/registry.hpp"
#include "cortex/core/type_model.hpp"

#include <memory>
#include <string>
#include <vector>

namespace cortex::toolkit {

// Gives the registry a class for each type that has none yet and that a plug-in of certain folders
// lists: beside pump.so stands pump.types. The plug-in is loaded when the first simplex of such a
// type, or of a child of it, is made; then Error is thrown where it cannot be. Returns what is
// wrong with the folders, a sentence each. Setup phase, once.
//
// The folders, an earlier one outranks: $CORTEX_AGENT_PLUGINS (':' between them),
// ~/.local/lib/cortex/agent, and lib/cortex/agent beside the program.
std::vector<std::string> offerPlugins(const std::shared_ptr<const TypeModel>& types,
                                      ClassRegistry& registry);

}  // namespace cortex::toolkit
