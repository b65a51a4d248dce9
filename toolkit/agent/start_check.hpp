// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "options.hpp"

namespace cortex::toolkit {

// --validate: prints all that a start would refuse or warn of, as `cortex validate --json` does.
// Nothing runs, and neither a network nor a device is talked to. False: it would be refused. Throws
// UsageError.
bool printStartFindings(const CommandLine& line);

}  // namespace cortex::toolkit
