// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

// What is said where no agent is heard. `server`: the Discovery Server that was asked; "": none.
namespace cortex::common {

// "no agent on domain 7", with the server that was asked.
std::string noAgent(int domain, const std::string& server);

// What to try where that server gave none.
std::string serverRemedy(const std::string& server);

}  // namespace cortex::common
