// SPDX-License-Identifier: Apache-2.0
#include "threads/cpu_claims.hpp"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

namespace cortex::cs {
namespace {

enum class Claimed : std::uint8_t { Yes, No, Unknown };  // Unknown: nobody can claim it here

// A socket whose name begins with a zero has no file, and ends with its process.
Claimed claimSocket(const std::string& name, int& made) {
    made = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (made < 0) return Claimed::Unknown;
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::ranges::copy(name, address.sun_path + 1);
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
    const bool bound = bind(made, reinterpret_cast<const sockaddr*>(&address), size) == 0;
    return bound ? Claimed::Yes : errno == EADDRINUSE ? Claimed::No : Claimed::Unknown;
}

// Whoever runs as another user may have made the file: it is read only, and stays there for good.
int openShared(const std::string& path) {
    constexpr int flags = O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;
    const int found = open(path.c_str(), flags);
    if (found >= 0) return found;
    const int made = open(path.c_str(), flags | O_CREAT | O_EXCL, 0444);
    return made >= 0 || errno != EEXIST ? made : open(path.c_str(), flags);
}

// Whoever released it between our open and our lock has removed the file: then it is made anew.
Claimed claimFile(const std::string& path, int& opened) {
    for (;;) {
        opened = openShared(path);
        if (opened < 0) return Claimed::Unknown;
        if (flock(opened, LOCK_EX | LOCK_NB) != 0) {
            return errno == EWOULDBLOCK ? Claimed::No : Claimed::Unknown;
        }
        struct stat file{};
        if (fstat(opened, &file) != 0 || file.st_nlink > 0) return Claimed::Yes;
        close(opened);
    }
}

}  // namespace

CpuClaims::CpuClaims(std::vector<std::string> folders) : folders_{std::move(folders)} {}

CpuClaims::~CpuClaims() { release(); }

void CpuClaims::release() {
    for (const Held& each : held_) letGo(each);
    held_.clear();
}

// The file goes before its lock ends, so that nobody locks one that is about to go.
void CpuClaims::letGo(const Held& held) {
    if (held.opened < 0) return;
    if (!held.path.empty()) unlink(held.path.c_str());
    close(held.opened);
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

// What cannot be claimed, as where a folder cannot be written, nobody can have claimed either.
bool CpuClaims::claim(int cpu) {
    const std::string name = "cortex-cpu-" + std::to_string(cpu);
    std::vector<Held> taken(1);
    bool free = claimSocket(name, taken.front().opened) != Claimed::No;
    for (std::size_t i = 0; free && i < folders_.size(); ++i) {
        const std::string path = folders_[i] + "/" + name;
        int opened = -1;
        const Claimed claimed = claimFile(path, opened);
        free = claimed != Claimed::No;
        taken.push_back({opened, claimed == Claimed::Yes ? path : ""});
    }
    for (const Held& each : taken) {
        if (free) {
            held_.push_back(each);
        } else {
            letGo(each);
        }
    }
    return free;
}

}  // namespace cortex::cs
