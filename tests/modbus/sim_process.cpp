// SPDX-License-Identifier: Apache-2.0
#include "modbus/sim_process.hpp"

#include "drive/ds402_registers.hpp"
#include "support/waiting.hpp"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <arpa/inet.h>
#include <netinet/in.h>

namespace cortex::modbus::test {
namespace {

using cortex::test::patience;

sockaddr_in loopback(std::uint16_t port) {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(port);
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return place;
}

bool isReadable(int descriptor) {
    pollfd wanted{descriptor, POLLIN, 0};
    const auto time = std::chrono::duration_cast<std::chrono::milliseconds>(patience);
    return poll(&wanted, 1, static_cast<int>(time.count())) > 0;
}

void append(Octets& octets, int word) {
    octets.push_back(static_cast<std::uint8_t>(word >> 8));
    octets.push_back(static_cast<std::uint8_t>(word));
}

Words wordsIn(const Octets& answer) {
    if ((answer[0] & 0x80) != 0) throw std::runtime_error("exception " + std::to_string(answer[1]));
    Words words;
    for (std::size_t i = 2; i + 1 < answer.size(); i += 2)
        words.push_back(static_cast<std::uint16_t>(answer[i] << 8 | answer[i + 1]));
    return words;
}

}  // namespace

SimProcess::SimProcess(std::vector<std::string> options, std::string executable)
    : options_{std::move(options)}, program_{std::move(executable)} {
    const auto given = [&](const char* option) {
        return std::ranges::find(options_, option) != options_.end();
    };
    const bool isDrive = program_ == "cortex-ds402-sim";
    if (isDrive && !given("--longest-pause"))
        options_.insert(options_.end(), {"--longest-pause", "0"});
    if (isDrive && !given("--self-test")) options_.insert(options_.end(), {"--self-test", "10"});
    start(0);
    // Bound, but not listening: nobody else gets the port between two lives.
    place_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const int yes = 1;
    setsockopt(place_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
}

SimProcess::~SimProcess() {
    if (pid_ > 0) {
        signal(SIGCONT);
        EXPECT_EQ(endInOrder(SIGTERM), 0) << program_ << " did not end in order";
    }
    kill9();
    if (place_ >= 0) close(place_);
}

void SimProcess::start(std::uint16_t port) {
    std::vector<std::string> command{CORTEX_BINARY_DIR "/bin/" + program_, "--port",
                                     std::to_string(port)};
    command.insert(command.end(), options_.begin(), options_.end());
    std::vector<char*> arguments;
    for (std::string& each : command) arguments.push_back(each.data());
    arguments.push_back(nullptr);
    int both[2];
    if (pipe2(both, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    pid_ = fork();
    if (pid_ < 0) throw std::runtime_error("cannot fork");
    if (pid_ == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        dup2(both[1], STDOUT_FILENO);
        execv(arguments.front(), arguments.data());
        _exit(127);
    }
    close(both[1]);
    if (output_ >= 0) close(output_);
    output_ = both[0];
    const std::string line = readLine();
    const std::string start = program_ + ": listening on 127.0.0.1:";
    if (!line.starts_with(start)) throw std::runtime_error("it prints: " + line);
    port_ = static_cast<std::uint16_t>(std::stoi(line.substr(start.size())));
}

std::string SimProcess::readLine() {
    std::string line;
    char octet = 0;
    while (isReadable(output_) && ::read(output_, &octet, 1) == 1 && octet != '\n') line += octet;
    printed_ += line + "\n";
    return line;
}

testing::AssertionResult SimProcess::prints(const std::string& text) {
    while (printed_.find(text) == std::string::npos)
        if (readLine().empty())
            return testing::AssertionFailure() << "'" << text << "' is not in:\n" << printed_;
    return testing::AssertionSuccess();
}

void SimProcess::kill9() {
    if (pid_ > 0) {
        ::kill(pid_, SIGKILL);
        waitpid(std::exchange(pid_, 0), nullptr, 0);
    }
    if (output_ >= 0) close(std::exchange(output_, -1));
    const sockaddr_in here = loopback(port_);
    if (place_ >= 0) bind(place_, reinterpret_cast<const sockaddr*>(&here), sizeof here);
}

void SimProcess::restart() {
    kill9();
    start(port_);
}

void SimProcess::signal(int number) const { ::kill(pid_, number); }

int SimProcess::endInOrder(int number) {
    signal(number);
    const auto status = cortex::test::statusOf(std::exchange(pid_, 0));
    return status && WIFEXITED(*status) ? WEXITSTATUS(*status) : -1;
}

bool SimProcess::hasEnded() const { return !cortex::test::howItEnded(pid_).empty(); }

BareClient::BareClient(std::uint16_t port)
    : socket_{socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)} {
    const sockaddr_in place = loopback(port);
    if (connect(socket_, reinterpret_cast<const sockaddr*>(&place), sizeof place) != 0)
        throw std::runtime_error("no connection to port " + std::to_string(port));
}

BareClient::~BareClient() { close(socket_); }

void BareClient::hangUp() { shutdown(socket_, SHUT_WR); }

void BareClient::send(std::span<const std::uint8_t> octets) const {
    if (::send(socket_, octets.data(), octets.size(), MSG_NOSIGNAL) !=
        static_cast<ssize_t>(octets.size()))
        throw std::runtime_error("cannot send");
}

Octets BareClient::receive(std::size_t count) const {
    Octets octets(count);
    for (std::size_t at = 0; at < count;) {
        if (!isReadable(socket_)) throw std::runtime_error("no answer");
        const ssize_t more = recv(socket_, &octets[at], count - at, 0);
        if (more <= 0) throw std::runtime_error("it has hung up");
        at += static_cast<std::size_t>(more);
    }
    return octets;
}

bool BareClient::isClosed() const {
    std::array<std::uint8_t, 512> octets;
    while (isReadable(socket_))
        if (recv(socket_, octets.data(), octets.size(), 0) <= 0) return true;
    return false;
}

Octets BareClient::ask(const Octets& request) {
    Octets octets;
    append(octets, ++transaction_);
    append(octets, 0);
    append(octets, static_cast<int>(request.size()) + 1);
    octets.push_back(1);
    octets.insert(octets.end(), request.begin(), request.end());
    send(octets);
    const Octets header = receive(7);
    EXPECT_EQ((Octets{header[0], header[1], header[2], header[3]}),
              (Octets{octets[0], octets[1], 0, 0}));
    EXPECT_EQ(header[6], 1);
    return receive(static_cast<std::size_t>(header[4] << 8 | header[5]) - 1);
}

Words BareClient::read(std::uint16_t first, std::uint16_t count) {
    Octets request{3};
    append(request, first);
    append(request, count);
    return wordsIn(ask(request));
}

int BareClient::write(std::uint16_t first, const Words& values) {
    Octets request{16};
    append(request, first);
    append(request, static_cast<int>(values.size()));
    request.push_back(static_cast<std::uint8_t>(2 * values.size()));
    for (const std::uint16_t each : values) append(request, each);
    const Octets answer = ask(request);
    return (answer[0] & 0x80) != 0 ? answer[1] : 0;
}

Words BareClient::exchange(const Words& told) {
    Octets request{23};
    append(request, Ds402Map::read);
    append(request, Ds402Map::readCount);
    append(request, Ds402Map::write);
    append(request, Ds402Map::writeCount);
    request.push_back(static_cast<std::uint8_t>(2 * Ds402Map::writeCount));
    for (std::size_t i = 0; i < Ds402Map::writeCount; ++i)
        append(request, i < told.size() ? told[i] : 0);
    return wordsIn(ask(request));
}

}  // namespace cortex::modbus::test
