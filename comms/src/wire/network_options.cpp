// SPDX-License-Identifier: Apache-2.0
#include "cortex/comms/network_options.hpp"

#include "cortex/core/error.hpp"

#include <charconv>
#include <cstdlib>
#include <iterator>
#include <sstream>
#include <string_view>

namespace cortex::comms {

int defaultDomain() {
    const char* text = std::getenv("CORTEX_DOMAIN");
    if (!text) return 0;
    const std::string_view digits{text};
    int domain = -1;
    const auto [end, error] = std::from_chars(digits.begin(), digits.end(), domain);
    if (error != std::errc{} || end != digits.end() || domain < 0 || domain > lastDomain) {
        throw Error{"CORTEX_DOMAIN is '" + std::string{digits} +
                    "'; set it to a number from 0 to " + std::to_string(lastDomain) +
                    ", or unset it for domain 0"};
    }
    return domain;
}

std::vector<std::string> defaultInterfaces() {
    const char* text = std::getenv("CORTEX_INTERFACE");
    std::istringstream words{text != nullptr ? text : ""};
    return {std::istream_iterator<std::string>{words}, {}};
}

std::string defaultDiscoveryServer() {
    const char* servers = std::getenv("CORTEX_DISCOVERY_SERVER");
    return servers != nullptr ? servers : "";
}

std::string defaultSecurity() {
    const char* folder = std::getenv("CORTEX_SECURITY");
    return folder != nullptr ? folder : "";
}

}  // namespace cortex::comms
