// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <sys/types.h>

#include <gtest/gtest.h>

namespace cortex::modbus::test {

using Words = std::vector<std::uint16_t>;
using Octets = std::vector<std::uint8_t>;

// A program that simulates a device. It ends in order with its object, and is killed with the test.
// Its port is its own while it is dead, too. Unless told otherwise cortex-ds402-sim takes no pause
// for a fault, and its self test is short.
class SimProcess {
public:
    explicit SimProcess(std::vector<std::string> options = {},
                        std::string executable = "cortex-ds402-sim");
    ~SimProcess();
    SimProcess(const SimProcess&) = delete;
    SimProcess& operator=(const SimProcess&) = delete;

    std::uint16_t port() const { return port_; }
    std::string address() const { return "127.0.0.1:" + std::to_string(port_); }
    void kill9();
    void restart();  // at the same place
    void signal(int number) const;
    int endInOrder(int number);  // the exit code; -1 after a signal
    bool hasEnded() const;
    testing::AssertionResult prints(const std::string& text);  // sooner or later

private:
    void start(std::uint16_t port);
    std::string readLine();

    std::vector<std::string> options_;
    std::string program_;
    pid_t pid_ = 0;
    int output_ = -1, place_ = -1;
    std::uint16_t port_ = 0;
    std::string printed_;
};

// A client that has a socket and octets, and no library. Each waits, and throws where nothing
// comes.
class BareClient {
public:
    explicit BareClient(std::uint16_t port);
    ~BareClient();
    BareClient(const BareClient&) = delete;
    BareClient& operator=(const BareClient&) = delete;

    void send(std::span<const std::uint8_t> octets) const;
    Octets receive(std::size_t count) const;
    bool isClosed() const;  // by the other side, sooner or later
    void hangUp();          // says that nothing more comes

    // The answer from the function code on, to a request from there on.
    Octets ask(const Octets& request);
    Words read(std::uint16_t first, std::uint16_t count);
    // FC 16; the exception, 0: none.
    int write(std::uint16_t first, const Words& values);
    // FC 23 of the process image: the first words of it, the rest is 0.
    Words exchange(const Words& told);

private:
    int socket_ = -1;
    std::uint16_t transaction_ = 0;
};

}  // namespace cortex::modbus::test
