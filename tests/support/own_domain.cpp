// SPDX-License-Identifier: Apache-2.0
#include "support/own_domain.hpp"

#include <fstream>
#include <stdexcept>
#include <string>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace cortex::test {
namespace {

constexpr int domains = 99, portsOfADomain = 250, firstPort = 7400;

bool portsAreFree(int domain) {
    std::ifstream sockets{"/proc/net/udp"};  // each line: number, address:port in hex, …
    std::string line;
    std::getline(sockets, line);
    while (std::getline(sockets, line)) {
        const std::size_t colon = line.find(':', line.find(':') + 1);
        const int port = std::stoi(line.substr(colon + 1, 4), nullptr, 16);
        const int above = port - firstPort - domain * portsOfADomain;
        if (above >= 0 && above < portsOfADomain) return false;
    }
    return true;
}

// The lock ends with the process: its file stays open.
bool lock(int domain) {
    const std::string name = "/tmp/cortex-test-domain-" + std::to_string(domain);
    int file = open(name.c_str(), O_RDONLY | O_CLOEXEC);  // another user may have made it
    if (file < 0) file = open(name.c_str(), O_RDONLY | O_CREAT | O_CLOEXEC, 0644);
    if (file >= 0 && flock(file, LOCK_EX | LOCK_NB) == 0 && portsAreFree(domain)) return true;
    if (file >= 0) close(file);
    return false;
}

int freeDomain() {
    for (int offset = 0; offset < domains; ++offset) {
        const int domain = 1 + (getpid() + offset) % domains;
        if (lock(domain)) return domain;
    }
    throw std::runtime_error("every domain of DDS from 1 to 99 is used");
}

}  // namespace

int ownDomain() {
    static const int domain = freeDomain();
    return domain;
}

int secondDomain() {
    static const int domain = (ownDomain(), freeDomain());
    return domain;
}

}  // namespace cortex::test
