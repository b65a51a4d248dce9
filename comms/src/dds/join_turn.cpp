// SPDX-License-Identifier: Apache-2.0
#include "dds/join_turn.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>
#include <thread>

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace cortex::comms {
namespace {

using namespace std::chrono_literals;

// Not all at once if there is no turn to be had.
const auto longestWait = 120s + 1s * (getpid() % 256);
// Of each who waits: the more they are, the sooner one of them looks. Many wait long.
constexpr std::chrono::nanoseconds shortestPause = 5ms, longestPause = 250ms;
constexpr int pausesOfAWait = 100;
constexpr auto timeOfADatagram = 25us;  // measured: 17 us on two cores, to send and receive it
constexpr auto patience = 100ms, patienceForEach = 20ms;

// Only one socket of a network namespace can have an abstract name, and it goes with its process.
bool take(int socket, int domain) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string name = "cortex/join/" + std::to_string(domain);
    std::ranges::copy(name, address.sun_path + 1);
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
    return bind(socket, reinterpret_cast<const sockaddr*>(&address), size) == 0;
}

}  // namespace

JoinTurn::JoinTurn(int domain) : socket_{socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)} {
    const auto start = std::chrono::steady_clock::now();
    while (socket_ >= 0 && !take(socket_, domain)) {
        const std::chrono::nanoseconds waited = std::chrono::steady_clock::now() - start;
        if (waited > longestWait) return;
        std::this_thread::sleep_for(
            std::clamp(waited / pausesOfAWait, shortestPause, longestPause));
    }
}

JoinTurn::~JoinTurn() {
    if (socket_ >= 0) close(socket_);
}

void JoinTurn::letAnswer(std::uint32_t others) const {
    std::this_thread::sleep_for(others * others * timeOfADatagram);
}

// Some of the others may be of other makers, and are never met.
void JoinTurn::meet(std::uint32_t others, const std::function<std::uint32_t()>& met) const {
    auto last = std::chrono::steady_clock::now();
    std::uint32_t before = 0;
    for (std::uint32_t all = met(); all < others; all = met()) {
        const auto now = std::chrono::steady_clock::now();
        if (all > before) last = now;
        if (now - last > patience + others * patienceForEach) return;
        before = all;
        std::this_thread::sleep_for(1ms);
    }
}

}  // namespace cortex::comms
