// SPDX-License-Identifier: Apache-2.0
#include "modbus/test_servers.hpp"

#include "support/waiting.hpp"

#include <array>
#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include <sys/socket.h>
#include <unistd.h>

#include <arpa/inet.h>
#include <modbus/modbus.h>
#include <netinet/in.h>
#include <netinet/tcp.h>

namespace cortex::modbus::test {
namespace {

constexpr int places = 100;

void expect(bool isRight, const char* what) {
    if (!isRight) throw std::runtime_error(std::string{"the server of a test: "} + what);
}

}  // namespace

std::string hex(const Bytes& bytes) {
    std::string text;
    std::array<char, 4> digits{};
    for (const std::uint8_t byte : bytes) {
        std::snprintf(digits.data(), digits.size(), "%02x", byte);
        text += (text.empty() ? "" : " ") + std::string{digits.data()};
    }
    return text;
}

// Two sockets may have a port that neither has without asking, and only one of them listens.
int Listener::open() const {
    const int made = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const int yes = 1;
    setsockopt(made, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    place.sin_port = htons(port_);
    expect(bind(made, reinterpret_cast<sockaddr*>(&place), sizeof place) == 0, "bind");
    return made;
}

Listener::Listener() : reserved_{open()} {
    sockaddr_in place{};
    socklen_t length = sizeof place;
    expect(getsockname(reserved_, reinterpret_cast<sockaddr*>(&place), &length) == 0, "name");
    port_ = ntohs(place.sin_port);
}

Listener::~Listener() {
    end();
    ::close(reserved_);
}

std::string Listener::address() const { return "127.0.0.1:" + std::to_string(port_); }

void Listener::listen() {
    const int made = open();
    expect(::listen(made, 4) == 0, "listen");
    listening_ = made;
}

int Listener::accept() const {
    const int socket = ::accept4(listening_, nullptr, nullptr, SOCK_CLOEXEC);
    const int yes = 1;
    if (socket >= 0) setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    return socket;
}

void Listener::end() {
    const int open = listening_.exchange(-1);
    if (open < 0) return;
    ::shutdown(open, SHUT_RDWR);
    ::close(open);
}

void Server::serve(std::function<void(int)> one) {
    isOver_ = false;
    listener_.listen();
    thread_ = std::thread{[this, one = std::move(one)] {
        for (int socket = listener_.accept(); socket >= 0; socket = listener_.accept()) {
            {
                const std::lock_guard lock{mutex_};
                socket_ = socket;
            }
            one(socket);
            const std::lock_guard lock{mutex_};
            ::shutdown(socket, SHUT_RDWR);
            ::close(std::exchange(socket_, -1));
        }
        isOver_ = true;
    }};
}

void Server::wake() {
    const std::lock_guard lock{mutex_};
    if (socket_ >= 0) ::shutdown(socket_, SHUT_RDWR);
}

void Server::leave() {
    listener_.end();
    while (!isOver_) {  // the thread may just have accepted the next one
        wake();
        std::this_thread::yield();
    }
    if (thread_.joinable()) thread_.join();
}

ModbusServer::ModbusServer() : mapping_{modbus_mapping_new(places, places, places, places)} {
    comeBack();
}

ModbusServer::~ModbusServer() {
    leave();
    modbus_mapping_free(mapping_);
}

void ModbusServer::comeBack() {
    server_.serve([this](int socket) { serveOne(socket); });
}

void ModbusServer::serveOne(int socket) {
    modbus_t* context = modbus_new_tcp("127.0.0.1", 0);
    modbus_set_socket(context, socket);
    std::array<std::uint8_t, MODBUS_TCP_MAX_ADU_LENGTH> request{};
    for (int size = 0; (size = modbus_receive(context, request.data())) >= 0;) {
        if (size == 0) continue;
        const std::lock_guard lock{mutex_};
        requests_.emplace_back(request.begin(), request.begin() + size);
        if (request[6] == unreachable)
            modbus_reply_exception(context, request.data(), MODBUS_EXCEPTION_GATEWAY_TARGET);
        else
            modbus_reply(context, request.data(), size, mapping_);
        came_.notify_all();
    }
    modbus_free(context);
}

std::vector<Bytes> ModbusServer::requests() {
    const std::lock_guard lock{mutex_};
    return requests_;
}

void ModbusServer::waitForRequests(std::size_t more) {
    std::unique_lock lock{mutex_};
    const std::size_t wanted = requests_.size() + more;
    expect(came_.wait_for(lock, cortex::test::patience, [&] { return requests_.size() >= wanted; }),
           "it waits for requests in vain");
}

RawServer::RawServer(Behaviour behaviour) : behaviour_{std::move(behaviour)} {
    server_.serve([this](int socket) { serveOne(socket); });
}

void RawServer::serveOne(int socket) const {
    std::array<std::uint8_t, 300> buffer{};
    for (ssize_t size = 0; (size = ::recv(socket, buffer.data(), buffer.size(), 0)) > 0;) {
        const Answer answer = behaviour_({buffer.begin(), buffer.begin() + size});
        const std::size_t all = answer.octets.size(), step = answer.trickles ? 1 : all;
        for (std::size_t at = 0; at < all; at += step) {
            if (::send(socket, answer.octets.data() + at, step, MSG_NOSIGNAL) < 0) return;
            if (answer.trickles) std::this_thread::sleep_for(std::chrono::milliseconds{2});
        }
        if (answer.hangsUp) return;
    }
}

Bytes rightAnswer(const Bytes& request, const std::vector<std::uint16_t>& words) {
    Bytes answer{request.begin(), request.begin() + 8};  // head, unit, function
    answer[4] = 0;
    answer[5] = static_cast<std::uint8_t>(3 + 2 * words.size());
    answer.push_back(static_cast<std::uint8_t>(2 * words.size()));
    for (const std::uint16_t word : words) {
        answer.push_back(static_cast<std::uint8_t>(word >> 8));
        answer.push_back(static_cast<std::uint8_t>(word & 0xFF));
    }
    return answer;
}

Bytes exceptionAnswer(const Bytes& request, std::uint8_t code) {
    Bytes answer{request.begin(), request.begin() + 8};
    answer[4] = 0;
    answer[5] = 3;
    answer[7] |= 0x80;
    answer.push_back(code);
    return answer;
}

}  // namespace cortex::modbus::test
