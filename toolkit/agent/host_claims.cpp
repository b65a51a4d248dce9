// SPDX-License-Identifier: Apache-2.0
#include "host_claims.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/printable.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace cortex::toolkit {
namespace {

struct Address {
    sockaddr_un name{};
    socklen_t size = 0;
    const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&name); }
};

// In the abstract namespace (unix(7)): such a name has no file and ends with its socket. It has 107
// octets, and a path may have more; so it is a number, by FNV-1a.
Address addressOf(const std::string& what) {
    std::uint64_t number = 0xcbf29ce484222325;
    for (const char each : what) {
        number ^= static_cast<unsigned char>(each);
        number *= 0x100000001b3;
    }
    Address address;
    address.name.sun_family = AF_UNIX;
    const int size = std::snprintf(address.name.sun_path + 1, sizeof address.name.sun_path - 1,
                                   "cortex-claim-%016llx", static_cast<unsigned long long>(number));
    address.size =
        static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1) + static_cast<socklen_t>(size);
    return address;
}

// "cortex-agent line.xml --offline", as far as the system shows it.
std::string commandOf(pid_t process) {
    std::ifstream file{"/proc/" + std::to_string(process) + "/cmdline", std::ios::binary};
    std::string text{std::istreambuf_iterator<char>{file}, {}};
    while (text.ends_with('\0')) text.pop_back();
    const std::size_t program = text.substr(0, text.find('\0')).rfind('/');
    if (program != std::string::npos) text.erase(0, program + 1);
    std::ranges::replace(text, '\0', ' ');
    constexpr std::size_t most = 80;
    return printable(text.size() <= most ? text : text.substr(0, most) + "…");
}

std::string holderOf(const Address& address) {
    constexpr const char* unknown = "another process";
    const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (socket < 0) return unknown;
    ucred peer{};
    socklen_t size = sizeof peer;
    const bool isKnown = connect(socket, address.get(), address.size) == 0 &&
                         getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0;
    close(socket);
    if (!isKnown || peer.pid <= 0) return unknown;
    const std::string command = commandOf(peer.pid);
    return "process " + std::to_string(peer.pid) + (command.empty() ? "" : " (" + command + ")");
}

}  // namespace

HostClaims::~HostClaims() {
    for (const auto& [what, socket] : sockets_) close(socket);
}

std::string HostClaims::take(const std::string& what) {
    if (sockets_.contains(what)) return {};
    const Address address = addressOf(what);
    const auto fail = [&] { throw Error("no claim on " + what + ": " + std::strerror(errno)); };
    const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (socket < 0) fail();
    if (bind(socket, address.get(), address.size) == 0) {
        listen(socket, SOMAXCONN);  // so that others learn who has it; nobody is ever accepted
        sockets_.emplace(what, socket);
        return {};
    }
    const bool isTaken = errno == EADDRINUSE;
    close(socket);
    if (!isTaken) fail();
    return holderOf(address);
}

}  // namespace cortex::toolkit
