// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <modbus/modbus.h>

namespace cortex::modbus::test {

using Bytes = std::vector<std::uint8_t>;
std::string hex(const Bytes& bytes);  // "00 1f"

// A TCP port of this machine that is kept for one test: others connect only while it listens.
class Listener {
public:
    Listener();
    ~Listener();
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;

    std::string address() const;  // "127.0.0.1:40000"
    void listen();
    int accept() const;  // the next connection; below 0 after end()
    void end();          // nobody is served any more, and accept() returns

private:
    int open() const;
    std::uint16_t port_ = 0;
    int reserved_;
    std::atomic<int> listening_{-1};
};

// Serves one connection after the other on a thread.
class Server {
public:
    Server() = default;
    ~Server() { leave(); }
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    std::string address() const { return listener_.address(); }
    void serve(std::function<void(int socket)> one);  // it neither closes nor keeps the socket
    void leave();                                     // as one that is switched off

private:
    void wake();

    Listener listener_;
    std::mutex mutex_;
    int socket_ = -1;
    std::atomic<bool> isOver_{true};
    std::thread thread_;
};

// A Modbus/TCP server by libmodbus, with 100 of each kind of place.
class ModbusServer {
public:
    ModbusServer();
    ~ModbusServer();
    ModbusServer(const ModbusServer&) = delete;
    ModbusServer& operator=(const ModbusServer&) = delete;

    std::string address() const { return server_.address(); }
    void leave() { server_.leave(); }
    void comeBack();  // with what was in its tables

    // With the tables to oneself.
    template <class Look>
    auto look(Look look) {
        const std::lock_guard lock{mutex_};
        return look(*mapping_);
    }
    std::vector<Bytes> requests();  // whole, that came so far
    void waitForRequests(std::size_t more);
    // Answers requests to this unit, as a gateway that does not reach it: exception 11. -1: none.
    std::atomic<int> unreachable{-1};

private:
    void serveOne(int socket);

    modbus_mapping_t* mapping_;
    std::mutex mutex_;
    std::condition_variable came_;
    std::vector<Bytes> requests_;
    Server server_;
};

// A server that answers each request with octets that the test makes of it, and that may hang up.
class RawServer {
public:
    struct Answer {
        Bytes octets{};
        bool hangsUp = false;
        bool trickles = false;  // octet by octet, some 2 ms apart
    };
    using Behaviour = std::function<Answer(const Bytes& request)>;

    explicit RawServer(Behaviour behaviour);
    std::string address() const { return server_.address(); }

private:
    void serveOne(int socket) const;

    Behaviour behaviour_;
    Server server_;
};

// The answer to a read of registers, as it should be.
Bytes rightAnswer(const Bytes& request, const std::vector<std::uint16_t>& words);
Bytes exceptionAnswer(const Bytes& request, std::uint8_t code);

}  // namespace cortex::modbus::test
