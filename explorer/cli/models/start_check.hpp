// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "models/model.hpp"

namespace cortex::cli {

// Adds to a model what the start of its agent would find: `cortex-agent --validate`, of the program
// that is installed beside this one, makes all simplexes ready and runs none. `files`: as named on
// the command line. False: nothing was checked, and a note in the report says why.
bool checkStart(Model& model, const Paths& files, const Paths& plugins);

}  // namespace cortex::cli
