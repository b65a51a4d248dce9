// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

namespace cortex::toolkit {

// What one process of this host has at a time: a file that it keeps, a device that it talks to. The
// kernel gives a claim back when the process ends, however it does, and nothing is left behind.
// Processes in another network namespace do not see it. Program's thread.
class HostClaims {
public:
    HostClaims() = default;
    ~HostClaims();
    HostClaims(const HostClaims&) = delete;
    HostClaims& operator=(const HostClaims&) = delete;

    // Empty: this process has it from now on, or has it already. Otherwise who has it: "process
    // 4711 (cortex-agent line.xml)". Throws Error where no claim can be made at all.
    std::string take(const std::string& what);

private:
    std::map<std::string, int> sockets_;
};

}  // namespace cortex::toolkit
