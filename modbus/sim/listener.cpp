// SPDX-License-Identifier: Apache-2.0
#include "sim/listener.hpp"

#include <cerrno>
#include <cstring>
#include <memory>
#include <stdexcept>

#include <netdb.h>
#include <unistd.h>

#include <netinet/in.h>
#include <netinet/tcp.h>

namespace cortex::modbus::sim {
namespace {

constexpr int waiting = 16;  // connections that nobody has accepted yet

sockaddr* general(sockaddr_storage& place) { return reinterpret_cast<sockaddr*>(&place); }

std::string why(int error) {
    std::string text = std::strerror(error);
    if (error == EADDRINUSE) text += "; another program listens there: give another --port";
    if (error == EACCES) text += "; ports below 1024 need a right: give another --port";
    if (error == EADDRNOTAVAIL) text += "; this machine has no such --address";
    return text;
}

}  // namespace

void Descriptor::close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
}

Listener::Listener(const std::string& address, std::uint16_t port) {
    addrinfo wanted{}, *found = nullptr;
    wanted.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV | AI_PASSIVE;
    wanted.ai_socktype = SOCK_STREAM;
    const int failed = getaddrinfo(address.c_str(), std::to_string(port).c_str(), &wanted, &found);
    const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> owned{found, &freeaddrinfo};
    if (failed != 0)
        throw std::runtime_error("'" + address +
                                 "' is no address; write one in numbers, such as 127.0.0.1");
    length_ = found->ai_addrlen;
    std::memcpy(&place_, found->ai_addr, length_);
    held_ = bound();
    getsockname(held_.number(), general(place_), &length_);
    open();
}

// Two sockets may be bound to one place as long as neither of them listens.
Descriptor Listener::bound() {
    Descriptor bound{socket(place_.ss_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)};
    const int yes = 1;
    setsockopt(bound.number(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    if (bind(bound.number(), general(place_), length_) != 0)
        throw std::runtime_error("cannot listen on " + text() + ": " + why(errno));
    return bound;
}

void Listener::open() {
    if (isOpen()) return;
    listening_ = bound();
    if (listen(listening_.number(), waiting) != 0)
        throw std::runtime_error("cannot listen on " + text() + ": " + why(errno));
}

std::string Listener::text() const {
    char host[NI_MAXHOST], port[NI_MAXSERV];
    getnameinfo(reinterpret_cast<const sockaddr*>(&place_), length_, host, sizeof host, port,
                sizeof port, NI_NUMERICHOST | NI_NUMERICSERV);
    const bool isV6 = place_.ss_family == AF_INET6;
    return (isV6 ? "[" : "") + std::string{host} + (isV6 ? "]:" : ":") + port;
}

Descriptor Listener::accept() const {
    Descriptor accepted{
        accept4(listening_.number(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK)};
    const int yes = 1;
    if (accepted.isOpen())
        setsockopt(accepted.number(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    return accepted;
}

}  // namespace cortex::modbus::sim
