// SPDX-License-Identifier: Apache-2.0
#include "common/no_agent.hpp"

namespace cortex::common {

std::string noAgent(int domain, const std::string& server) {
    return "no agent on domain " + std::to_string(domain) +
           (server.empty() ? "" : " by way of the Discovery Server " + server);
}

std::string serverRemedy(const std::string& server) {
    return "see that the server runs at " + server +
           " (fast-discovery-server -i 0) and that the agents name it too, or leave "
           "--discovery-server (CORTEX_DISCOVERY_SERVER) out: the agents may be found without it";
}

}  // namespace cortex::common
