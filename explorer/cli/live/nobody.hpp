// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace cortex::cli {

// What is known where no agent was heard.
struct Nobody {
    int domain = 0;
    std::chrono::milliseconds waited{0};
    std::vector<std::string> interfaces;  // that were named; none: all
    std::string server;                   // Discovery Server that was asked; "": none
    std::vector<int> otherDomains;        // of which this machine has participants
    std::uint32_t closed = 0;             // participants with security, while we have none
    std::uint32_t nameless = 0;           // participants that did not say who they are
    std::uint64_t strangers = 0;          // messages whose sender security refused
    std::string refused;                  // what else was refused, as a sentence; "": nothing
};

struct Trouble {
    std::string what, remedy;
    bool isError = false;  // somebody is there, and this tool cannot see him
};
Trouble troubleOf(const Nobody& nobody);

// "domains 3, 4"; "" without any.
std::string domainsText(const std::vector<int>& domains);

// "2 participants with security were heard"; "" without any.
std::string closedText(std::uint32_t count);
inline constexpr const char* nameAFolder =
    "name a folder that 'cortex security create-agent' made (--security FOLDER or CORTEX_SECURITY)";

// "1 participant of CorteX was found and did not say who it is"; "" without any.
std::string namelessText(std::uint32_t count);

}  // namespace cortex::cli
