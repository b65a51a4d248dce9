// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/error.hpp"
#include "cortex/cs/trigger_source.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <arpa/inet.h>
#include <netinet/in.h>

namespace cortex::cs {

namespace {

[[noreturn]] void refuseTrigger(const std::string& what, int error) {
    throw Error(what + ": " + std::strerror(error));
}

bool comesLater(int error) { return error == EAGAIN || error == EWOULDBLOCK || error == EINTR; }

// One tick for each datagram, also an empty one; what it says does not matter.
std::int64_t takeDatagrams(int descriptor) {
    constexpr std::int64_t most = 10'000;
    std::int64_t ticks = 0;
    for (char first = 0; ticks < most; ++ticks) {
        if (recv(descriptor, &first, 1, MSG_DONTWAIT) >= 0) continue;
        if (!comesLater(errno)) refuseTrigger("the socket of the ticks", errno);
        break;
    }
    return ticks;
}

std::int64_t takeBytes(int descriptor) {
    std::array<char, 4096> bytes;
    const ssize_t count = read(descriptor, bytes.data(), bytes.size());
    if (count == 0) throw Error("whoever sent the ticks has closed its end");
    if (count < 0 && !comesLater(errno)) refuseTrigger("the descriptor of the ticks", errno);
    return std::max<std::int64_t>(count, 0);
}

std::int64_t takeCount(int descriptor) {
    std::uint64_t count = 0;
    const ssize_t size = read(descriptor, &count, sizeof count);
    if (size < 0 && !comesLater(errno)) refuseTrigger("the counter of the ticks", errno);
    return size == sizeof count ? static_cast<std::int64_t>(count) : 0;
}

using Taking = std::int64_t (*)(int descriptor);

Taking takingOf(int descriptor) {
    constexpr std::array kinds{
        std::pair<mode_t, Taking>{S_IFSOCK, takeDatagrams},
        std::pair<mode_t, Taking>{S_IFIFO, takeBytes},
        std::pair<mode_t, Taking>{S_IFCHR, takeBytes},
        std::pair<mode_t, Taking>{0, takeCount},  // what has no place in a file system
    };
    const std::string name = "descriptor " + std::to_string(descriptor) + " for ticks";
    struct stat status{};
    if (fstat(descriptor, &status) != 0) refuseTrigger(name, errno);
    int type = SOCK_DGRAM;
    socklen_t size = sizeof type;
    getsockopt(descriptor, SOL_SOCKET, SO_TYPE, &type, &size);
    for (const auto& [kind, take] : kinds) {
        if ((status.st_mode & S_IFMT) == kind && type != SOCK_STREAM) return take;
    }
    throw Error(name + ": it is no socket for datagrams, pipe, device, eventfd or timerfd");
}

}  // namespace

DescriptorTrigger::DescriptorTrigger(int descriptor, std::chrono::nanoseconds nominalPeriod)
    : descriptor_{descriptor}, take_{takingOf(descriptor)}, period_{nominalPeriod.count()} {
    if (period_ <= 0) throw Error("the nominal period of a DescriptorTrigger must be positive");
    interrupt_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    if (interrupt_ < 0) refuseTrigger("a trigger needs a descriptor of its own", errno);
}

DescriptorTrigger::~DescriptorTrigger() {
    close(descriptor_);
    close(interrupt_);
}

int DescriptorTrigger::openUdp(const std::string& address, std::uint16_t port) {
    const std::string name = "UDP port " + std::to_string(port) + " of " + address + " for ticks";
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(port);
    if (inet_pton(AF_INET, address.c_str(), &place.sin_addr) != 1) {
        throw Error(name + ": the address is none of IPv4, such as 127.0.0.1");
    }
    const int made = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (made < 0) refuseTrigger(name, errno);
    if (bind(made, reinterpret_cast<const sockaddr*>(&place), sizeof place) == 0) return made;
    const int error = errno;
    close(made);
    refuseTrigger(name, error);
}

bool DescriptorTrigger::isReadable(int milliseconds) const {
    std::array<pollfd, 2> both{pollfd{descriptor_, POLLIN, 0}, pollfd{interrupt_, POLLIN, 0}};
    poll(both.data(), both.size(), milliseconds);
    return both[0].revents != 0;
}

void DescriptorTrigger::takePending() { pending_ += take_(descriptor_); }

void DescriptorTrigger::start() {
    constexpr int most = 100;  // who floods it must not keep the loop from its start
    for (int i = 0; i < most && isReadable(0); ++i) take_(descriptor_);
}

Trigger DescriptorTrigger::waitForTick() {
    if (skip_ && isReadable(0)) takePending();
    const auto isEnded = [this] {
        return interrupted_.load(std::memory_order_acquire) ||
               timedOut_.load(std::memory_order_acquire);
    };
    while (pending_ == 0 && !isEnded()) {
        if (isReadable(-1)) takePending();
    }
    Trigger trigger;
    trigger.timedOut = timedOut_.exchange(false, std::memory_order_acq_rel);
    if (trigger.timedOut) takeCount(interrupt_);
    trigger.stopped = interrupted_.load(std::memory_order_acquire);
    if (skip_) trigger.periods = std::max<std::int64_t>(pending_, 1);
    seen_ += trigger.periods;
    pending_ = std::max<std::int64_t>(pending_ - trigger.periods, 0);
    trigger.nominalTime = (seen_ - 1) * period_;
    return trigger;
}

void DescriptorTrigger::interrupt() {
    interrupted_.store(true, std::memory_order_release);
    endWait();
}

// The cycle that follows counts as a tick of its own.
bool DescriptorTrigger::timeOut() {
    timedOut_.store(true, std::memory_order_release);
    endWait();
    return true;
}

void DescriptorTrigger::endWait() const {
    const std::uint64_t one = 1;
    // Into an empty counter one always fits.
    [[maybe_unused]] const auto written = write(interrupt_, &one, sizeof one);
}

}  // namespace cortex::cs
