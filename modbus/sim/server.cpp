// SPDX-License-Identifier: Apache-2.0
#include "sim/server.hpp"

#include <algorithm>
#include <cerrno>
#include <utility>
#include <vector>

namespace cortex::modbus::sim {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t mostConnections = 16;
constexpr std::chrono::nanoseconds longestWait = 1ms;  // so that the model goes on

short eventsOf(const Connection& connection) {
    return static_cast<short>((connection.wantsToReceive() ? POLLIN : 0) |
                              (connection.waitsForRoom() ? POLLOUT : 0));
}

}  // namespace

// The registers as one connection may use them.
class Server::Access final : public Registers {
public:
    Access(Server& server, const Connection& who) : server_{server}, who_{who} {}

    Exception read(std::uint16_t first, std::span<std::uint16_t> to) override {
        return meetsFrozen(first) ? Exception::Failure : device().read(first, to);
    }
    Exception write(std::uint16_t first, std::span<const std::uint16_t> values) override {
        if (first >= faultsFrom) return device().write(first, values);
        const Connection*& commander = server_.commander_;
        if (meetsFrozen(first) || (commander != nullptr && commander != &who_))
            return Exception::Failure;
        const Exception wrong = device().write(first, values);
        hasCommanded_ = wrong == Exception::None;
        if (hasCommanded_) commander = &who_;
        return wrong;
    }
    bool hasCommanded() const { return hasCommanded_; }
    bool metFrozen() const { return metFrozen_; }

private:
    SimulatedDevice& device() { return server_.device_; }
    bool meetsFrozen(std::uint16_t first) {
        const bool meets = first < faultsFrom && device().link.isFrozen();
        metFrozen_ = metFrozen_ || meets;
        return meets;
    }

    Server& server_;
    const Connection& who_;
    bool hasCommanded_ = false, metFrozen_ = false;
};

void Server::run(int end) {
    now_ = Clock::now();
    while (wait(end)) {
        for (Connection& connection : connections_) serve(connection);
        lookAtRefusal();
        removeClosed();
    }
}

// Until something has come, or time has to go on. False: the end.
bool Server::wait(int end) {
    std::vector<pollfd> wanted{{end, POLLIN, 0}, {listener_.descriptor(), POLLIN, 0}};
    auto until = Clock::now() + longestWait;
    for (const Connection& connection : connections_) {
        wanted.push_back({connection.descriptor(), eventsOf(connection), 0});
        until = std::min(until, connection.due());
    }
    const auto time = std::max(0ns, until - Clock::now());
    const timespec limit{0, static_cast<long>(time.count())};
    ppoll(wanted.data(), wanted.size(), &limit, nullptr);
    goOn();
    std::size_t at = 2;
    for (Connection& connection : connections_)
        if (wanted[at++].revents & (POLLIN | POLLHUP | POLLERR)) connection.receive();
    if (wanted[1].revents & POLLIN) {
        Descriptor socket = listener_.accept();
        if (socket.isOpen() && connections_.size() < mostConnections)
            connections_.emplace_back(std::move(socket));
    }
    return wanted[0].revents == 0;
}

void Server::goOn() {
    const auto before = std::exchange(now_, Clock::now());
    const auto passed = now_ - before;
    if (longestPause_ > 0ns && passed > longestPause_)
        device_.stoodStill(passed);
    else
        device_.step(passed);
}

void Server::serve(Connection& connection) {
    while (const auto asked = connection.next()) answer(connection, *asked);
    connection.send(now_);
}

void Server::answer(Connection& connection, const Frame& asked) {
    Access access{*this, connection};
    Frame answer{asked.transaction, asked.unit, answerTo(asked.content, access)};
    if (access.metFrozen()) return;
    if (!device_.isExchange(asked.function())) return connection.answer(answer.onTheWire(), now_);
    if (access.hasCommanded()) device_.exchanged();
    const auto due = now_ + device_.link.takeDelay();
    const auto way = device_.link.takeWrongWay();
    connection.answer(way ? spoilt(answer, *way) : answer.onTheWire(), due);
    lastImage_ = std::move(answer.content);
}

Octets Server::spoilt(Frame answer, WrongWay way) const {
    const auto refused = static_cast<std::uint8_t>(answer.function() | FunctionCode::failed);
    if (way == WrongWay::OtherTransaction) ++answer.transaction;
    if (way == WrongWay::OldImage && lastImage_.size() == answer.content.size())
        answer.content = lastImage_;
    if (way == WrongWay::OtherFunction) answer.content[0] = FunctionCode::readHolding;
    if (way == WrongWay::TooShort && answer.content.size() > 4) {
        answer.content.resize(answer.content.size() - 2);
        answer.content[1] = static_cast<std::uint8_t>(answer.content[1] - 2);
    }
    if (way == WrongWay::Refusal)
        answer.content = {refused, static_cast<std::uint8_t>(Exception::Failure)};
    Octets octets = answer.onTheWire();
    if (way == WrongWay::Half) octets.resize(octets.size() / 2);
    if (way == WrongWay::NoModbus) octets[2] = octets[3] = 0xFF;
    return octets;
}

// Nobody could end a refusal when the last connection is gone, so that it ends itself.
void Server::lookAtRefusal() {
    if (connections_.empty()) device_.link.registers[LinkFaults::refuse] = 0;
    if (!device_.link.refuses()) return listener_.open();
    listener_.refuse();
    for (Connection& connection : connections_)
        if (&connection == commander_) connection.hangUp();
}

void Server::removeClosed() {
    std::erase_if(connections_, [this](const Connection& connection) {
        if (connection.isOpen()) return false;
        if (std::exchange(commander_, &connection == commander_ ? nullptr : commander_) ==
            &connection)
            device_.disconnected();
        return true;
    });
}

}  // namespace cortex::modbus::sim
