// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include <sys/socket.h>

namespace cortex::modbus::sim {

// A descriptor that is closed with its object.
class Descriptor {
public:
    Descriptor() = default;
    explicit Descriptor(int number) : number_{number} {}
    ~Descriptor() { close(); }
    Descriptor(Descriptor&& other) noexcept : number_{other.release()} {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        close();
        number_ = other.release();
        return *this;
    }
    int number() const { return number_; }
    bool isOpen() const { return number_ >= 0; }
    void close();

private:
    int release() {
        const int number = number_;
        number_ = -1;
        return number;
    }
    int number_ = -1;
};

// A place at which a TCP server listens, or refuses while the place stays its own.
class Listener {
public:
    // `address`: IPv4 or IPv6, in numbers. Port 0: any that is free. Throws std::runtime_error with
    // what, where and remedy.
    Listener(const std::string& address, std::uint16_t port);

    std::string text() const;  // "127.0.0.1:40000", "[::1]:40000"
    void open();
    void refuse() { listening_.close(); }
    bool isOpen() const { return listening_.isOpen(); }
    int descriptor() const { return listening_.number(); }
    Descriptor accept() const;  // not open where nobody is there

private:
    Descriptor bound();

    sockaddr_storage place_{};
    socklen_t length_ = 0;
    Descriptor held_, listening_;  // held_: bound, but not listening
};

}  // namespace cortex::modbus::sim
