// SPDX-License-Identifier: Apache-2.0
#include "threads/cpu_claims.hpp"

#include <algorithm>
#include <cerrno>
#include <cstddef>

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace cortex::cs {

CpuClaims::~CpuClaims() { release(); }

void CpuClaims::release() {
    for (const int socket : sockets_) close(socket);
    sockets_.clear();
}

std::vector<int> CpuClaims::take(const std::vector<int>& cpus, std::size_t count) {
    std::vector<int> claimed;
    for (const int cpu : cpus) {
        if (claimed.size() == count) break;
        if (claim(cpu)) claimed.push_back(cpu);
    }
    if (claimed.size() == count) return claimed;
    release();
    return {};
}

// Where there are no such sockets, nobody can have claimed anything.
bool CpuClaims::claim(int cpu) {
    const int made = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (made < 0) return true;
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string name = "cortex-cpu-" + std::to_string(cpu);
    std::ranges::copy(name, address.sun_path + 1);  // the zero before it: a name without a file
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
    if (bind(made, reinterpret_cast<const sockaddr*>(&address), size) != 0 && errno == EADDRINUSE) {
        close(made);
        return false;
    }
    sockets_.push_back(made);
    return true;
}

}  // namespace cortex::cs
