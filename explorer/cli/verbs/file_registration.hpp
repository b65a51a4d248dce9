// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verbs/verb_registration.hpp"

namespace cortex::cli {

// The verbs of verbs.hpp, which read and make files of models.
void addFileVerbs(Verbs& verbs);

}  // namespace cortex::cli
