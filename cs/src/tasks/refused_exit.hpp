// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace cortex::cs {

// "plug-in a.so called exit(1) in stateActive of /arm", of the first such call; "": there was none.
std::string refusedExitText();
// False: there is one already.
bool noteRefusedExit(std::string text);

}  // namespace cortex::cs
