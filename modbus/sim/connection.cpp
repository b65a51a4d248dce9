// SPDX-License-Identifier: Apache-2.0
#include "sim/connection.hpp"

#include <array>
#include <cerrno>

namespace cortex::modbus::sim {

void Connection::receive() {
    std::array<std::uint8_t, 4096> octets;
    const ssize_t count = recv(descriptor(), octets.data(), octets.size(), 0);
    if (count > 0) {
        inbox_.add({octets.data(), static_cast<std::size_t>(count)});
    } else if (count == 0 || (errno != EAGAIN && errno != EINTR)) {
        isOpen_ = false;
    }
}

std::optional<Frame> Connection::next() {
    if (!isOpen_ || !wantsToReceive()) return std::nullopt;
    std::optional<Frame> frame = inbox_.take();
    if (inbox_.isSpoilt()) isOpen_ = false;
    return frame;
}

void Connection::send(Clock::time_point now) {
    isFull_ = false;
    while (isOpen_ && !isFull_ && due() <= now) {
        const Octets& first = waiting_.front().octets;
        const ssize_t count =
            ::send(descriptor(), first.data() + sent_, first.size() - sent_, MSG_NOSIGNAL);
        if (count < 0) {
            isFull_ = errno == EAGAIN || errno == EINTR;
            isOpen_ = isFull_;
            return;
        }
        sent_ += static_cast<std::size_t>(count);
        if (sent_ < first.size()) continue;
        waiting_.pop_front();
        sent_ = 0;
    }
}

}  // namespace cortex::modbus::sim
